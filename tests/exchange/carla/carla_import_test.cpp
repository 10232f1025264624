#include "exchange/carla/carla_import.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <unistd.h>

#include <gmock/gmock.h>

#include "replay/trace_reader.h"
#include "tests/exchange/carla_logs.h"
#include "tests/support/worlds.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/random.h"

namespace reprise::exchange {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::carla_log;
using testing::ElementsAre;

constexpr std::uint64_t step_ns = 50'000'000;

double short_cycle(double /*speed*/, double /*height*/) {
    return 1.5;
}

class CarlaImport : public testing::Test {
  protected:
    CarlaImport()
        : path_(fs::temp_directory_path() /
                ("reprise_import_" + std::to_string(getpid()) + ".mcap")) {}

    ~CarlaImport() override { fs::remove(path_); }

    CarlaReport import_bytes(const std::string& bytes, std::optional<CarlaTown> town = {}) {
        CarlaImportOptions options;
        options.name = "drive.log";
        options.town = std::move(town);
        options.timing = {step_ns, short_cycle};
        options.progress = [](std::uint64_t) {};
        return import_carla(bytes_of(bytes), options, path_);
    }

    replay::TraceReader imported(const std::string& options) {
        import_bytes(carla_log(options));
        return replay::TraceReader(path_);
    }

    fs::path path_;
};

const world::CarState& car(const replay::RecordedTick& tick, std::uint32_t id) {
    const world::CarState* found = world::find(tick.view.cars(), id);
    if (found == nullptr)
        throw std::runtime_error("no car " + std::to_string(id));
    return *found;
}

/// By the book: clockwise round a circle of 30 m at 10 m/s. In our frame, y north, the middle of
/// the car is at angle -t/3 and heads a right angle further on.
TEST_F(CarlaImport, BringsACircleRound) {
    for (const std::string options : {"", "--ue5", "--additional"}) {
        replay::TraceReader trace = imported(options);
        const world::VehicleModel& model = *world::vehicle_models().data();  // sedan
        ASSERT_GE(trace.ticks(), 190U);
        for (std::uint64_t index = 1; index <= trace.ticks(); ++index) {
            const double time = world::seconds(index, step_ns);
            const world::CarState& state = car(trace.tick(index), 24);
            const double yaw = world::wrap_angle(-time / 3 - std::numbers::pi / 2);
            EXPECT_NEAR(world::wrap_angle(static_cast<double>(state.yaw()) - yaw), 0, 3e-3);
            const Eigen::Vector3d middle =
                world::pose(state.position(), static_cast<double>(state.yaw()), 0) *
                Eigen::Vector3d(model.length / 2 - model.rear_overhang, 0, 0);
            EXPECT_NEAR(middle.x(), 30 * std::cos(-time / 3), 0.03) << index;
            EXPECT_NEAR(middle.y(), 30 * std::sin(-time / 3), 0.03) << index;
            EXPECT_NEAR(state.speed(), 10, 0.02) << "a chord is shorter than its arc";
        }
    }
}

TEST_F(CarlaImport, GivesTheSameTicksForFloatsAndDoubles) {
    replay::TraceReader floats = imported("--additional");
    std::vector<world::CarState> of_floats;
    for (std::uint64_t index = 1; index <= floats.ticks(); ++index)
        for (const world::CarState& state : floats.tick(index).view.cars())
            of_floats.push_back(state);
    replay::TraceReader doubles = imported("--additional --ue5");
    std::size_t at = 0;
    for (std::uint64_t index = 1; index <= doubles.ticks(); ++index)
        for (const world::CarState& state : doubles.tick(index).view.cars()) {
            ASSERT_LT(at, of_floats.size());
            const world::CarState& other = of_floats[at++];
            EXPECT_EQ(state.id(), other.id());
            EXPECT_EQ(state.lamps(), other.lamps());
            EXPECT_LT(
                (world::to_eigen(state.position()) - world::to_eigen(other.position())).norm(),
                2.0 / 1024);
            EXPECT_NEAR(state.yaw(), other.yaw(), 2.0 / 8192);
        }
    EXPECT_EQ(at, of_floats.size());
}

TEST_F(CarlaImport, LiftsWhoDrivesUphill) {
    replay::TraceReader trace = imported("");
    const world::CarState& lorry = car(trace.tick(100), 25);
    EXPECT_NEAR(lorry.pitch(), std::atan(0.05), 1e-3);
    EXPECT_NEAR(lorry.speed(), 5, 0.01);
    const world::VehicleModel& model = world::vehicle_models()[lorry.model()];
    EXPECT_STREQ(model.name, "lorry");
    const double along = 25 - (model.length / 2 - model.rear_overhang);
    EXPECT_NEAR(lorry.position().z(), along * std::sin(std::atan(0.05)), 0.01);
    EXPECT_NEAR(lorry.position().y(), -50, 0.01) << "right of CARLA's x axis is south";
}

TEST_F(CarlaImport, PutsWalkersOnTheGroundAndMovesTheirLegsWithTheWay) {
    replay::TraceReader trace = imported("--additional");
    const auto walker = [&](std::uint64_t index) { return trace.tick(index).view.walkers()[0]; };
    EXPECT_NEAR(walker(50).position().z(), 0, 2e-3);
    EXPECT_NEAR(walker(50).position().y(), 1.5 * 2.5, 0.01);
    EXPECT_NEAR(walker(50).yaw(), std::numbers::pi / 2, 1e-3);
    EXPECT_NEAR(walker(50).speed(), 1.5, 0.01);
    const double cycles = 1.5 * 2 / short_cycle(1.5, 1.7);  // in two seconds
    const double phase = static_cast<double>(walker(90).phase() - walker(50).phase());
    EXPECT_NEAR(std::remainder(phase - cycles, 1), 0, 0.01);
}

TEST_F(CarlaImport, GivesEveryActorALookForGood) {
    replay::TraceReader trace = imported("");
    std::map<std::uint32_t, std::uint32_t> seen;
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index) {
        const replay::RecordedTick tick = trace.tick(index);
        std::map<std::uint32_t, std::uint32_t> looks;
        for (const world::CarState& state : tick.view.cars()) {
            const world::Look* look = world::find(tick.view.car_looks(), state.id());
            ASSERT_NE(look, nullptr) << state.id();
            looks[state.id()] = look->look();
        }
        for (const world::WalkerState& state : tick.view.walkers())
            looks[state.id()] = state.look();
        for (const auto& [id, look] : looks) {
            EXPECT_NE(look, 0U);
            EXPECT_EQ(seen.emplace(id, look).first->second, look) << id << " at tick " << index;
        }
    }
    EXPECT_EQ(seen.size(), 5U);
}

TEST_F(CarlaImport, RollsWheelsAsFarAsTheCarGoes) {
    replay::TraceReader trace = imported("");
    const float before = car(trace.tick(20), 24).lane_s();
    const float after = car(trace.tick(60), 24).lane_s();
    EXPECT_NEAR(after - before, 20, 0.05);
}

TEST_F(CarlaImport, LightsLamps) {
    replay::TraceReader trace = imported("");
    const replay::RecordedTick early = trace.tick(100);
    EXPECT_EQ(car(early, 24).lamps(), world::lamp_low_beam);
    EXPECT_EQ(car(early, 25).lamps(), world::lamp_left | world::lamp_reverse) << "gear -1";
    EXPECT_EQ(car(early, 28).lamps(), world::lamp_right | world::lamp_low_beam) << "high beam";
    EXPECT_EQ(car(trace.tick(180), 24).lamps(), world::lamp_low_beam | world::lamp_brake);
}

TEST_F(CarlaImport, TellsWhoComesAndGoesAndCollides) {
    replay::TraceReader trace = imported("");
    std::vector<std::string> told;
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
        for (const world::Event* event : *trace.tick(index).view.tick->events()) {
            told.push_back(std::string(world::EnumNameEventKind(event->kind())) + " " +
                           std::to_string(event->actor()) + " " +
                           (event->text() == nullptr ? "" : event->text()->str()));
            const double time = world::seconds(index, step_ns);
            if (event->kind() == world::EventKind::collision) {
                EXPECT_EQ(event->other(), 28U);
                EXPECT_NEAR(time, 4.1, 0.1);
            }
            if (event->kind() == world::EventKind::despawned) {
                EXPECT_NEAR(time, 6.1, 0.1);
            }
        }
    EXPECT_THAT(told,
                ElementsAre("spawned 24 hero",
                            "spawned 25 vehicle.carlamotors.carlacola",
                            "spawned 26 vehicle.someone.newbike",
                            "spawned 27 walker.pedestrian.0021",
                            "spawned 28 vehicle.someone.newcar",
                            "collision 24 ",
                            "despawned 25 "));
    EXPECT_EQ(trace.tick(40).view.cars().size(), 3U);
    EXPECT_EQ(trace.tick(90).view.cars().size(), 4U);
    EXPECT_EQ(trace.tick(140).view.cars().size(), 3U);
}

TEST_F(CarlaImport, GuessesUnknownVehiclesBySizeAndSaysSo) {
    const CarlaReport report = import_bytes(carla_log("--additional"));
    EXPECT_THAT(report.guessed, testing::Contains("vehicle.someone.newcar: bus, by its size"));
    EXPECT_THAT(import_bytes(carla_log("")).guessed,
                testing::Contains("vehicle.someone.newcar: sedan, as any vehicle"));
}

TEST_F(CarlaImport, MarksTheTraceAndNamesTheHero) {
    replay::TraceReader trace = imported("");
    EXPECT_EQ(
        trace.episode().imported_from,
        "CARLA recorder file drive.log (UE4), map Carla/Maps/Town01, 2020-09-13 12:26:40 UTC");
    ASSERT_EQ(trace.episode().parameters.size(), 1U);
    EXPECT_EQ(trace.episode().parameters[0].value, "24");
    EXPECT_EQ(trace.outcome().verdict, "completed");
}

TEST_F(CarlaImport, ShiftsPlacesToTheTownsOriginAndShowsItsSignals) {
    CarlaTown town;
    town.town = test::straight_road_with_signal();
    town.town.signals[0].position = world::Vec3(35 + 100, 2 + 50, 0);  // 5.4 m from the trigger
    town.network = "<net><location netOffset=\"100.00,50.00\" projParameter=\"!\"/></net>";
    const CarlaReport report = import_bytes(carla_log("--additional"), town);
    EXPECT_EQ(report.matched, 1U);
    replay::TraceReader trace(path_);
    EXPECT_NEAR(trace.tick(1).view.walkers()[0].position().x(), 10 + 100, 1e-3);
    EXPECT_NEAR(trace.tick(1).view.walkers()[0].position().y(), 1.5 * 0.05 + 50, 0.01);
    EXPECT_EQ(trace.tick(50).view.signals()[0], world::SignalColor::green);
    EXPECT_EQ(trace.tick(150).view.signals()[0], world::SignalColor::red);
}

TEST_F(CarlaImport, KeepsWhatIsWholeOfALogThatWasCutOff) {
    const CarlaReport report = import_bytes(carla_log("--cut 1000"));
    ASSERT_TRUE(report.damage);
    EXPECT_GT(report.lost, 0U);
    replay::TraceReader trace(path_);
    EXPECT_EQ(trace.outcome().verdict, "error");
    EXPECT_GT(trace.ticks(), 180U);
}

TEST_F(CarlaImport, WritesNothingForALogWithoutFrames) {
    const std::string header = carla_log("--frames 0");
    EXPECT_THROW(import_bytes(header), world::Error);
    EXPECT_THROW(import_bytes(carla_log("--frames 1")), world::Error) << "no time passes in it";
    EXPECT_FALSE(fs::exists(path_));
    EXPECT_FALSE(fs::exists(path_.string() + ".partial"));
}

/// Whatever the flipped bit says: a refusal, or a trace that reads from end to end.
TEST_F(CarlaImport, SurvivesBitFlips) {
    const std::string bytes = carla_log("--frames 12 --additional");
    std::size_t written = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        std::string flipped = bytes;
        const std::uint64_t bit =
            world::draw_index(8 * bytes.size(), 2, 0, world::Purpose::scenario, i);
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
        try {
            import_bytes(flipped);
        } catch (const world::Error&) {
            continue;
        }
        replay::TraceReader trace(path_);
        for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
            for (const world::CarState& state : trace.tick(index).view.cars())
                ASSERT_TRUE(std::isfinite(state.position().x() + state.position().y() +
                                          state.position().z()) &&
                            std::isfinite(state.speed() + state.yaw() + state.pitch()));
        ++written;
    }
    EXPECT_GT(written, 50U);
}

}  // namespace
}  // namespace reprise::exchange
