#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <gmock/gmock.h>

#include "render/ranging/sweep.h"
#include "render/ranging/untwist.h"
#include "render/sensors.h"
#include "tests/render/ranging/points.h"
#include "world/check.h"
#include "world/models/catalogue.h"

namespace reprise {

namespace {

using Eigen::Vector3d;
using test::clear;
using test::point_at;
using test::ranger;
using test::real_at;
using test::whole_at;
using world::SensorFrame;
using world::SensorKind;

SensorFrame seen(const world::TownT& town,
                 const world::SealedTick& tick,
                 const world::SensorSpec& spec,
                 const world::Weather& weather) {
    render::Sensors sensors(town);
    return sensors.observe(tick.view(), {spec}, weather)[0];
}

}  // namespace

TEST(Lidar, FramesOfASweepFollowOnEachOtherWithoutAGap) {
    world::SensorSpec spec = ranger(SensorKind::lidar, {{"points_per_second", 56000}});
    std::uint64_t next = 0;
    for (std::uint64_t tick = 1; tick <= 40; ++tick) {
        const render::Sweep sweep = render::sweep_of(spec, tick);
        ASSERT_FALSE(sweep.columns.empty());
        EXPECT_EQ(sweep.columns.front().number, next);
        for (const render::Sweep::Column& column : sweep.columns) {
            EXPECT_EQ(column.number, next++);
            EXPECT_GE(column.ago, 0);
            EXPECT_LT(column.ago, 0.05 + 1e-9);
            EXPECT_LE(std::abs(column.azimuth), std::numbers::pi);
        }
    }
    EXPECT_EQ(next, 56000U / 32 * 2) << "columns in two seconds";
    spec.every = 100;
    EXPECT_NEAR(static_cast<double>(render::sweep_of(spec, 200).columns.size()), 87.5, 0.5)
        << "one turn at most, of 50 ms";
}

TEST(Lidar, PointsOfTheRoadLieOnIt) {
    const world::SealedTick tick = test::tick_with({});
    world::SensorSpec spec = ranger(SensorKind::lidar);
    spec.position = {200, -1.75, 1.8};
    const SensorFrame frame = seen(test::straight_road(400), tick, spec, clear());
    int on_lane = 0;
    for (int i = 0; i < frame.height; ++i) {
        const Vector3d p = point_at(frame, i);
        if (std::abs(p.y()) > 1.5)
            continue;
        EXPECT_NEAR(p.z(), -1.8, 0.006) << "road, or paint 5 mm above it";
        ++on_lane;
    }
    EXPECT_GT(on_lane, 500);
}

TEST(Lidar, LabelsAreThoseOfAProbeAlongTheSameRayAndOfACamera) {
    const world::TownT town = test::street();
    const world::SealedTick tick = test::street_tick();
    for (const bool portable : {false, true}) {
        render::Sensors sensors(town, {.portable = portable});
        world::SensorSpec spec = ranger(SensorKind::semantic_lidar, {{"rolling", 0}});
        spec.position = {44, 0, 1.8};
        world::SensorSpec classes = test::camera(SensorKind::semantic, spec.position);
        const auto frames = sensors.observe(tick.view(), {spec, classes}, clear());
        const SensorFrame& points = frames[0];
        ASSERT_GT(points.height, 5000);

        std::vector<render::Probe> probes;
        for (int i = 0; i < points.height; ++i)
            probes.push_back({spec.position, point_at(points, i)});
        const auto answers = sensors.probe(tick.view(), probes, 100);
        int others = 0;
        for (int i = 0; i < points.height; ++i) {
            const render::ProbeEcho& answer = answers[static_cast<std::size_t>(i)];
            const bool same = whole_at(points, i, 5) == static_cast<std::uint32_t>(answer.label) &&
                              whole_at(points, i, 4) == answer.actor &&
                              std::abs(point_at(points, i).norm() - answer.distance) < 1e-4;
            others += static_cast<int>(!same);
        }
        EXPECT_LE(others, points.height / 1000) << "on edges: rays are rounded to single precision";

        probes.clear();
        for (int v = 0; v < 120; ++v)
            for (int u = 0; u < 160; ++u)
                probes.push_back({spec.position, {80, 79.5 - u, 59.5 - v}});
        const auto pixels = sensors.probe(tick.view(), probes, 1e6);
        others = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            others +=
                static_cast<int>(frames[1].data[i] != static_cast<std::uint8_t>(pixels[i].label));
        EXPECT_LE(others, 160 * 120 / 1000);
    }
}

TEST(Lidar, FogTakesItsLightByKoschmiedersLaw) {
    const world::SealedTick tick = test::street_tick();
    world::SensorSpec spec = ranger(SensorKind::lidar, {{"sensitivity_range", 2000}});
    spec.position = {44, 0, 1.8};
    world::Weather foggy = clear();
    foggy.mutate_fog_extinction(0.01F);
    const SensorFrame dry = seen(test::street(), tick, spec, clear());
    const SensorFrame fog = seen(test::street(), tick, spec, foggy);
    ASSERT_GT(dry.height, 5000);
    std::map<std::pair<std::uint32_t, float>, int> rows;
    for (int i = 0; i < dry.height; ++i)
        rows[{whole_at(dry, i, 5), static_cast<float>(real_at(dry, i, 4))}] = i;
    int compared = 0;
    for (int i = 0; i < fog.height; ++i) {
        const auto row = rows.find({whole_at(fog, i, 5), static_cast<float>(real_at(fog, i, 4))});
        if (row == rows.end())
            continue;
        const double range = point_at(dry, row->second).norm();
        if (std::abs(range - point_at(fog, i).norm()) > 1e-4 || real_at(dry, row->second, 3) > 0.99)
            continue;  // the fog itself; or too bright for the scale
        EXPECT_NEAR(
            real_at(fog, i, 3) / real_at(dry, row->second, 3), std::exp(-0.02 * range), 1e-4);
        ++compared;
    }
    EXPECT_GT(compared, 4000);
}

TEST(Lidar, RangeErrorIsWhatWasSaidAndItsOwnForEachTick) {
    const world::TownT town = test::straight_road(400);
    const world::SealedTick tick = test::tick_with({});
    world::SensorSpec spec = ranger(SensorKind::lidar, {{"noise_stddev", 0.1}});
    world::SensorSpec exact = ranger(SensorKind::lidar);
    spec.position = exact.position = {200, -1.75, 1.8};
    const SensorFrame noisy = seen(town, tick, spec, clear());
    const SensorFrame still = seen(town, tick, exact, clear());
    ASSERT_EQ(noisy.height, still.height);
    double squares = 0;
    for (int i = 0; i < noisy.height; ++i)
        squares += std::pow(point_at(noisy, i).norm() - point_at(still, i).norm(), 2);
    EXPECT_NEAR(std::sqrt(squares / noisy.height), 0.1, 0.005);
    // LISA's: accuracy / sqrt(2 SNR), here of the road straight below the mast.
    world::SensorSpec weak = exact;
    for (world::AttributeValue& one : weak.attributes)
        if (one.name == "range_accuracy")
            one.value = 0.09;
    const SensorFrame hazy = seen(town, tick, weak, clear());
    squares = 0;
    double expected = 0;
    for (int i = 0; i < hazy.height; ++i) {
        const double range = point_at(still, i).norm();
        const double ratio = real_at(still, i, 3) / (range * range) / (0.9 / 4e4);
        squares += std::pow(point_at(hazy, i).norm() - range, 2);
        expected += 0.09 * 0.09 / (2 * ratio);
    }
    EXPECT_NEAR(squares / expected, 1, 0.1);
}

TEST(Lidar, LosesPointsAsCarlaDoes) {
    const world::SealedTick tick = test::tick_with({});
    const auto count = [&](std::vector<world::AttributeValue> said) {
        world::SensorSpec spec = ranger(SensorKind::lidar, std::move(said));
        spec.position = {200, -1.75, 1.8};
        return static_cast<double>(seen(test::straight_road(400), tick, spec, clear()).height);
    };
    const double all = count({{"range", 20}});
    EXPECT_NEAR(count({{"range", 20}, {"dropoff_general_rate", 0.45}}) / all, 0.55, 0.02);
    // Without attenuation all are as bright as can be, and limits of 1 let (1 - 0.4 + 0.4) pass.
    EXPECT_EQ(
        count({{"range", 20}, {"dropoff_zero_intensity", 0.4}, {"dropoff_intensity_limit", 1}}),
        all);
    EXPECT_NEAR(count({{"range", 20},
                       {"dropoff_zero_intensity", 0.4},
                       {"dropoff_intensity_limit", 1},
                       {"atmosphere_attenuation_rate", 1}}) /
                    all,
                0.61,
                0.03)
        << "darkness lets 60 % pass, and a little more where the road is near";
}

TEST(Lidar, SensorThatMovesSeesAStandingWallFromWhereItWas) {
    world::SealedTick tick =
        test::tick_with({test::vehicle_at(1, 100, -1.75, 0, 20)}, {test::car_at(7, 130, -1.75)});
    world::SensorSpec spec =
        ranger(SensorKind::semantic_lidar, {{"horizontal_fov", 20}, {"upper_fov", 0}});
    spec.actor = 1;
    spec.position = {1, 0, 0.6};
    const SensorFrame rolls = seen(test::straight_road(400), tick, spec, clear());
    const auto tail = [](const SensorFrame& frame, double shift) {
        double least = 1e9;
        double most = 0;
        for (int i = 0; i < frame.height; ++i) {
            const Vector3d p = point_at(frame, i);
            if (whole_at(frame, i, 4) != 7 || std::abs(p.y()) > 0.3 || std::abs(p.z()) > 0.1)
                continue;
            const double x = p.x() + shift * real_at(frame, i, 6);
            least = std::min(least, x);
            most = std::max(most, x);
        }
        return std::pair(least, most);
    };
    const auto raw = tail(rolls, 0);
    const auto straight = tail(rolls, 20);
    ASSERT_LT(straight.first, 1e8);
    EXPECT_LT(straight.second - straight.first, 0.12) << "one bumper, where it stands";
    const double bumper = 29 - world::vehicle_models()[0].rear_overhang;
    EXPECT_NEAR(straight.first, bumper, 0.15);
    EXPECT_GT(raw.first, straight.first) << "it was farther away before the tick";
    SensorFrame untwisted = rolls;
    render::untwist(untwisted, tick.view(), spec);
    for (int i = 0; i < rolls.height; ++i) {
        const Vector3d moved = point_at(rolls, i) + Vector3d(20 * real_at(rolls, i, 6), 0, 0);
        ASSERT_LT((point_at(untwisted, i) - moved).norm(), 1e-4) << i;
    }
}

TEST(Lidar, RainPutsDropsNearAndWetRoadsHideFarAway) {
    const world::SealedTick tick = test::tick_with({});
    world::SensorSpec spec = ranger(SensorKind::lidar);
    spec.position = {200, -1.75, 1.8};
    world::Weather wet = clear();
    wet.mutate_rain(50);
    wet.mutate_wetness(1);
    const SensorFrame dry = seen(test::straight_road(400), tick, spec, clear());
    const SensorFrame rain = seen(test::straight_road(400), tick, spec, wet);
    const auto count = [](const SensorFrame& frame, auto which) {
        int found = 0;
        for (int i = 0; i < frame.height; ++i)
            found += static_cast<int>(which(point_at(frame, i)));
        return found;
    };
    const auto in_the_air = [](const Vector3d& p) { return p.z() > -1.5 && p.norm() < 15; };
    const auto far = [](const Vector3d& p) {
        return p.z() < -1.5 && p.norm() > 20 && std::abs(p.y()) < 3;
    };
    EXPECT_EQ(count(dry, in_the_air), 0);
    EXPECT_GT(count(rain, in_the_air), 50);
    EXPECT_LT(count(rain, far), count(dry, far) / 2);
}

TEST(Lidar, WiderBeamsReportWhatIsBehindAnEdge) {
    const world::SealedTick tick = test::street_tick();
    world::SensorSpec spec = ranger(SensorKind::lidar, {{"returns", 2}, {"beam_divergence", 0.01}});
    spec.position = {44, 0, 1.8};
    const SensorFrame frame = seen(test::street(), tick, spec, clear());
    int seconds = 0;
    for (int i = 1; i < frame.height; ++i)
        if (whole_at(frame, i, 6) == 1) {
            ++seconds;
            EXPECT_EQ(whole_at(frame, i - 1, 6), 0U);
            EXPECT_EQ(whole_at(frame, i - 1, 5), whole_at(frame, i, 5)) << "of one shot";
            EXPECT_GT(std::abs(point_at(frame, i - 1).norm() - point_at(frame, i).norm()), 1.0);
        }
    EXPECT_GT(seconds, 20);
}

TEST(Radar, TellsTheSpeedOfAnOncomingCar) {
    const world::TownT town = test::straight_road(400);
    const world::SealedTick tick = test::tick_with({test::vehicle_at(1, 100, -1.75, 0, 15)},
                                                   {test::car_at(7, 160, 1.75, 3.14159265, 10)});
    world::SensorSpec spec = ranger(SensorKind::radar);
    spec.actor = 1;
    spec.position = {3.8, 0, 0.6};
    const SensorFrame frame = seen(town, tick, spec, clear());
    ASSERT_GT(frame.height, 0);
    int of_car = 0;
    for (int i = 0; i < frame.height; ++i) {
        const double azimuth = real_at(frame, i, 1);
        const double depth = real_at(frame, i, 3);
        const double away = std::cos(azimuth) * std::cos(real_at(frame, i, 2));
        const bool is_car = depth > 50 && depth < 60 && std::abs(azimuth - 0.065) < 0.03 &&
                            real_at(frame, i, 0) < -20;
        const double expected = is_car ? -25 * away : -15 * away;
        EXPECT_NEAR(real_at(frame, i, 0), expected, 0.15) << i;
        of_car += static_cast<int>(is_car);
        EXPECT_LE(real_at(frame, i, 4), real_at(frame, std::max(i - 1, 0), 4))
            << "the strongest first";
        EXPECT_GE(real_at(frame, i, 4), 13);
    }
    EXPECT_GT(of_car, 0);
}

TEST(Radar, CarsAndPeopleHaveCrossSectionsOfTheirKind) {
    world::TickDraft draft;
    draft.traffic.cars = {test::car_at(7, 140, -1.75)};
    draft.traffic.walkers = {
        {world::Vec3(120, 1.75, 0), 0, 0, 0.3F, 20, 0, false, std::uint8_t{0}, 0U}};
    const world::SealedTick tick = world::seal(draft, {});
    world::SensorSpec spec = ranger(SensorKind::radar, {{"ray_spacing", 0.05}});
    spec.position = {100, -1.75, 0.8};
    const SensorFrame frame = seen(test::straight_road(400), tick, spec, clear());
    double car = 0;
    double walker = 0;
    for (int i = 0; i < frame.height; ++i) {
        const double section = std::pow(10, real_at(frame, i, 5) / 10);
        const double depth = real_at(frame, i, 3);
        const double left = depth * std::sin(real_at(frame, i, 1));
        if (depth > 37 && depth < 42 && std::abs(left) < 1.2)
            car += section;
        if (depth > 19 && depth < 21 && std::abs(left - 3.5) < 0.6)
            walker += section;
    }
    EXPECT_GT(10 * std::log10(car), 5);
    EXPECT_LT(10 * std::log10(car), 15);
    EXPECT_GT(10 * std::log10(walker), -10);
    EXPECT_LT(10 * std::log10(walker), 1);
}

TEST(Obstacle, IsTheNearestThingInItsTube) {
    const world::SealedTick tick =
        test::tick_with({test::vehicle_at(1, 100, -1.75)}, {test::car_at(7, 120, -1.75)});
    world::SensorSpec spec = ranger(SensorKind::obstacle, {{"distance", 30}});
    spec.actor = 1;
    spec.position = {3.8, 0, 0.8};
    const SensorFrame frame = seen(test::straight_road(400), tick, spec, clear());
    ASSERT_EQ(frame.height, 1);
    EXPECT_EQ(whole_at(frame, 0, 0), 7U);
    EXPECT_NEAR(real_at(frame, 0, 1), 20 - 3.8 - world::vehicle_models()[0].rear_overhang, 0.15);
    spec.attributes = {{"distance", 5}};
    EXPECT_EQ(seen(test::straight_road(400), tick, spec, clear()).height, 0);
}

TEST(Ranging, BytesDoNotDependOnThreadsOrOnWhatElseLooks) {
    const world::TownT town = test::street();
    const world::SealedTick tick = test::street_tick();
    world::SensorRig rig;
    for (const SensorKind kind : {SensorKind::lidar,
                                  SensorKind::semantic_lidar,
                                  SensorKind::radar,
                                  SensorKind::obstacle,
                                  SensorKind::depth}) {
        world::SensorSpec& spec = rig.emplace_back(ranger(kind));
        if (kind == SensorKind::lidar)
            spec.attributes = {{"range", 80}, {"points_per_second", 300000}, {"returns", 2}};
        if (kind == SensorKind::obstacle) {
            spec.attributes = {{"distance", 30}};
            spec.position = {3, 0, 0.8};
        }
        spec.actor = 1;
        spec.width = 64;
        spec.height = 48;
    }
    for (const bool portable : {false, true}) {
        render::Sensors one(town, {.threads = 1, .portable = portable});
        render::Sensors two(town, {.threads = 2, .portable = portable});
        const auto together = one.observe(tick.view(), rig, test::rain());
        const auto others = two.observe(tick.view(), rig, test::rain());
        for (std::size_t i = 0; i < rig.size(); ++i) {
            EXPECT_FALSE(together[i].data.empty()) << i;
            EXPECT_TRUE(together[i].data == others[i].data) << i;
            const auto alone = two.observe(tick.view(), {rig[i]}, test::rain())[0];
            EXPECT_TRUE(together[i].data == alone.data) << i;
        }
    }
}

TEST(Ranging, NamesTheActorThatIsNotThere) {
    world::SensorSpec spec = ranger(SensorKind::lidar);
    spec.actor = 99;
    EXPECT_THROW(seen(test::straight_road(400), test::tick_with({}), spec, clear()), world::Error);
}

}  // namespace reprise
