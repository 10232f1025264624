#include "kernel/drill/nudge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "replay/compare/divergence.h"
#include "tests/kernel/whole_run.h"

namespace reprise::test {

namespace {

using kernel::moved_by_units;
using kernel::parse_nudge;
using testing::HasSubstr;

constexpr std::uint64_t nudged_tick = 20;

/// One number of everything that has any, and what diff must call it. Where one unit may be lost in
/// the next sum, more of them show that what lies behind the record was moved, too.
struct Drill {
    const char* name;
    const char* target;  ///< as in --nudge TICK:TARGET
    const char* stage;
    const char* field;
    std::uint32_t actor;
    bool goes_on;  ///< the record of later ticks must differ, too
    const char* note = "1 unit in the last place apart";
};

void PrintTo(const Drill& drill, std::ostream* out) {
    *out << drill.target;
}

const world::Recording& street() {
    static const world::Recording recording = in_town1(R"(
        local lane = pick_lane{ length = 80, right = false, left = true }
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot', lane = lane, s = 20,
                           speed_kmh = 30 }
        spawn{ name = 'other', model = 'van', driver = 'traffic', lane = lane_left_of(lane), s = 30,
               speed_kmh = 30 }
        local child = spawn{ name = 'child', model = 'child', lane = lane, s = 70, offset = -5 }
        child:walk_to{ across = lane, speed = 2 }
        wait(0.9)
        ego:set_speed_kmh(55)
        wait(60))",
                                                       10,
                                                       2);
    return recording;
}

const std::vector<KeptTick>& undisturbed() {
    static const std::vector<KeptTick> ticks = run(street());
    return ticks;
}

/// Of the stages in their order.
std::vector<std::uint64_t> stage_digests(const KeptTick& tick) {
    const world::Digests& all = *tick.recorded().view.tick->digests();
    return {all.scenario(),
            all.controls(),
            all.traffic(),
            all.pedestrians(),
            all.physics(),
            all.measurements()};
}

std::size_t index_of(const std::string& stage) {
    const std::vector<std::string> names{
        "scenario", "controls", "traffic", "pedestrians", "physics", "measurements"};
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), stage) - names.begin());
}

class Drills : public testing::TestWithParam<Drill> {};

/// The promise: tick, stage, actor, field, both values, one unit; nothing earlier.
TEST_P(Drills, AreReportedAsExactlyThat) {
    const Drill& drill = GetParam();
    const auto expected = undisturbed();
    const auto found = run(street(), [&](kernel::Kernel& kernel) {
        kernel.nudge(parse_nudge(std::to_string(nudged_tick) + ":" + drill.target));
    });
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i + 1 < nudged_tick; ++i)
        ASSERT_EQ(compare(expected[i].recorded(), found[i].recorded()), std::nullopt) << i;
    const auto divergence =
        compare(expected[nudged_tick - 1].recorded(), found[nudged_tick - 1].recorded());
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->tick, nudged_tick);
    EXPECT_EQ(divergence->stage, drill.stage);
    EXPECT_EQ(divergence->field, drill.field);
    EXPECT_EQ(divergence->actor_id, drill.actor);
    EXPECT_EQ(divergence->note, drill.note);
    EXPECT_NE(divergence->expected, divergence->found);

    // The stage's digest tells it, too, and that of no stage before: the chain is about every byte.
    const auto wanted = stage_digests(expected[nudged_tick - 1]);
    const auto got = stage_digests(found[nudged_tick - 1]);
    const auto first = std::mismatch(wanted.begin(), wanted.end(), got.begin()).first;
    EXPECT_EQ(static_cast<std::size_t>(first - wanted.begin()), index_of(drill.stage));

    bool differs_later = false;
    for (std::size_t i = nudged_tick; i < found.size(); ++i)
        differs_later = differs_later ||
                        compare_recorded(expected[i].recorded(), found[i].recorded()).has_value();
    if (drill.goes_on) {
        EXPECT_TRUE(differs_later);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Kernel,
    Drills,
    testing::Values(
        Drill{"Friction", "road_friction", "scenario", "road_friction", 0, true},
        Drill{"Weather", "weather.rain", "scenario", "weather.rain", 0, true},
        Drill{"Throttle", "ego.throttle", "controls", "controls[actor 1].throttle", 1, true},
        Drill{"Steer", "1.steer", "controls", "controls[actor 1].steer", 1, false},
        Drill{"ScriptedCar", "other.speed", "traffic", "cars[id 2].speed", 2, false},
        Drill{"BackgroundCar",
              "1000004.position.y",
              "traffic",
              "cars[id 1000004].position.y",
              1000004,
              false},
        Drill{
            "WalkerPlace", "child.position.x", "pedestrians", "walkers[id 3].position.x", 3, false},
        Drill{"WalkerPhase", "child.phase", "pedestrians", "walkers[id 3].phase", 3, false},
        Drill{"Position", "ego.position.x", "physics", "vehicles[id 1].position.x", 1, true},
        Drill{"Height", "ego.position.z:-1", "physics", "vehicles[id 1].position.z", 1, true},
        Drill{
            "Orientation", "ego.orientation.z", "physics", "vehicles[id 1].orientation.z", 1, true},
        Drill{"Velocity", "ego.velocity.y", "physics", "vehicles[id 1].velocity.y", 1, true},
        Drill{"Spin",
              "ego.angular_velocity.y:65536",
              "physics",
              "vehicles[id 1].angular_velocity.y",
              1,
              true,
              "65536 units in the last place apart"},
        Drill{"Acceleration",
              "ego.acceleration.x",
              "physics",
              "vehicles[id 1].acceleration.x",
              1,
              false},
        Drill{"Odometer", "ego.odometer", "physics", "vehicles[id 1].odometer", 1, true},
        Drill{"Wheel",
              "ego.wheels[2].rotation:-16",
              "physics",
              "wheels[vehicle 1, index 2].rotation",
              1,
              true,
              "16 units in the last place apart"},
        Drill{"Skid",
              "ego.wheels[3].skid:-1",
              "physics",
              "wheels[vehicle 1, index 3].skid",
              1,
              false},
        Drill{"Measurement", "ego.speed", "measurements", "measurements[actor 1].speed", 1, true},
        Drill{"MeasuredZero",
              "ego.on_sidewalk",
              "measurements",
              "measurements[actor 1].on_sidewalk",
              1,
              false}),
    [](const testing::TestParamInfo<Drill>& tested) { return tested.param.name; });

TEST(Nudge, WhoOrWhatIsNotThereIsNamed) {
    const auto error = [](const std::string& nudge) {
        return error_of([&] {
            run(street(), [&](kernel::Kernel& kernel) { kernel.nudge(parse_nudge(nudge)); });
        });
    };
    EXPECT_EQ(error("20:egg.speed"),
              "--nudge 20:egg.speed: in tick 20 there is no actor 'egg' (did you mean 'ego'?); "
              "there are ego, other, child, and 10 background cars by their ids");
    EXPECT_EQ(error("20:ego.phase"), "--nudge 20:ego.phase: 'ego' has no 'phase' in tick 20");
}

TEST(Nudge, IsReadFromItsText) {
    const kernel::Nudge alone = parse_nudge("600");
    EXPECT_EQ(alone.tick, 600u);
    EXPECT_EQ(alone.field, "steer");
    EXPECT_EQ(alone.units, 0);
    const kernel::Nudge full = parse_nudge("7:blue.car: 2.wheels[3].rotation:-12");
    EXPECT_EQ(full.actor, "blue.car: 2");
    EXPECT_EQ(full.field, "wheels[3].rotation");
    EXPECT_EQ(full.units, -12);
    EXPECT_EQ(parse_nudge("7:weather.rain").actor, "");
    for (const char* text : {"",
                             "x",
                             "-3",
                             "7:",
                             "7:ego.speed:",
                             "7:ego.speed:0",
                             "7:ego.speed:1.5",
                             "7:ego",
                             "7:ego.id",
                             "7:ego.wheels[4].rotation"})
        EXPECT_THAT(error_of([&] { parse_nudge(text); }), HasSubstr("--nudge")) << text;
    EXPECT_THAT(error_of([] { parse_nudge("7:ego.velocty.x"); }),
                HasSubstr("did you mean 'velocity.x'?"));
}

TEST(Units, StepThroughAllNumbersInTheirOrder) {
    using limits = std::numeric_limits<double>;
    for (const double value : {1.0, -1.0, 0.1, -7e300, 1e-310, -5e-324, limits::min(), 2.0})
        EXPECT_EQ(moved_by_units(value, 1), std::nextafter(value, INFINITY)) << value;
    EXPECT_EQ(moved_by_units(0.0, 1), limits::denorm_min());
    EXPECT_EQ(moved_by_units(-0.0, 1), limits::denorm_min());
    EXPECT_EQ(moved_by_units(0.0, -1), -limits::denorm_min());
    EXPECT_EQ(moved_by_units(limits::denorm_min(), -3), -2 * limits::denorm_min());
    EXPECT_EQ(moved_by_units(std::nextafter(limits::max(), 0), 1), limits::max());
    EXPECT_THAT(error_of([] { moved_by_units(limits::max(), 1); }), HasSubstr("no number"));
    EXPECT_THAT(error_of([] { moved_by_units(-limits::max(), -1); }), HasSubstr("no number"));
}

}  // namespace

}  // namespace reprise::test
