#include "render/readings/readings.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>

#include <gmock/gmock.h>

#include "tests/support/worlds.h"
#include "world/check.h"

namespace reprise {

namespace {

using world::SensorKind;

world::SensorSpec reader(SensorKind kind) {
    world::SensorSpec spec;
    spec.name = "reader";
    spec.kind = kind;
    spec.actor = 1;
    spec.position = {0, 0, 0};
    return spec;
}

/// On a circle around (0, radius), counter-clockwise, at an angle from its lowest point.
world::VehicleState on_circle(double radius, double speed, double angle) {
    world::VehicleState state =
        test::vehicle_at(1, radius * std::sin(angle), radius * (1 - std::cos(angle)), angle, speed);
    const double inwards = speed * speed / radius;
    state.mutable_acceleration() =
        world::Vec3(-inwards * std::sin(angle), inwards * std::cos(angle), 0);
    state.mutable_angular_velocity() = world::Vec3(0, 0, speed / radius);
    return state;
}

}  // namespace

TEST(Imu, FeelsGravityAtRestAndVSquaredOverRInABend) {
    const world::SealedTick rest = test::tick_with({test::vehicle_at(1, 0, 0)});
    const world::Reading still = render::imu_reading(nullptr, rest.view(), reader(SensorKind::imu));
    EXPECT_THAT(still,
                testing::Pointwise(testing::DoubleNear(1e-12),
                                   std::vector<double>{0, 0, 9.81, 0, 0, 0, std::numbers::pi / 2}));

    const double radius = 50;
    const double speed = 10;
    const double step = speed / radius * 0.05;
    const world::SealedTick last = test::tick_with({on_circle(radius, speed, 1)});
    const world::SealedTick tick = test::tick_with({on_circle(radius, speed, 1 + step)});
    const world::TickView before = last.view();
    const world::Reading bend = render::imu_reading(&before, tick.view(), reader(SensorKind::imu));
    EXPECT_NEAR(bend[0], 0, 1e-9);
    EXPECT_NEAR(bend[1], speed * speed / radius, 1e-9);
    EXPECT_NEAR(bend[2], 9.81, 1e-12);
    EXPECT_NEAR(bend[5], speed / radius, 1e-12);
    // Two metres farther in, the circle is smaller at the same rate of turning.
    world::SensorSpec inside = reader(SensorKind::imu);
    inside.position = {0, 2, 0};
    EXPECT_NEAR(render::imu_reading(&before, tick.view(), inside)[1],
                speed * speed / (radius * radius) * (radius - 2),
                1e-9);
}

TEST(Imu, AxesAreTheSensorsOwn) {
    const world::SealedTick rest = test::tick_with({test::vehicle_at(1, 0, 0)});
    world::SensorSpec nose_up = reader(SensorKind::imu);
    nose_up.pitch = 0.2;
    const world::Reading felt = render::imu_reading(nullptr, rest.view(), nose_up);
    EXPECT_NEAR(felt[0], 9.81 * std::sin(0.2), 1e-12);
    EXPECT_NEAR(felt[2], 9.81 * std::cos(0.2), 1e-12);
    const world::SealedTick north =
        test::tick_with({test::vehicle_at(1, 0, 0, std::numbers::pi / 2)});
    EXPECT_NEAR(
        std::sin(render::imu_reading(nullptr, north.view(), reader(SensorKind::imu))[6]), 0, 1e-12);
}

TEST(Gnss, DegreesAreAsLongAsOnTheEllipsoid) {
    // Of WGS 84 at 45 degrees: 111131.745 m north, 78846.835 m east.
    const render::GlobePlace place =
        render::place_on_globe({45, 9}, 78846.835 / 100, 111131.745 / 100);
    EXPECT_NEAR(place.latitude_deg, 45.01, 1e-7);
    EXPECT_NEAR(place.longitude_deg, 9.01, 1e-7);
}

TEST(Gnss, ErrsByWhatWasSaid) {
    world::SensorSpec spec = reader(SensorKind::gnss);
    spec.attributes = {{"noise_alt_stddev", 2}, {"noise_lat_bias", 0.5}};
    double squares = 0;
    for (std::uint64_t tick = 1; tick <= 2000; ++tick) {
        const world::Reading reading = render::gnss_reading(tick, spec, {10, 20}, 100);
        EXPECT_DOUBLE_EQ(reading[0], 10.5);
        EXPECT_DOUBLE_EQ(reading[1], 20);
        squares += std::pow(reading[2] - 100, 2);
    }
    EXPECT_NEAR(std::sqrt(squares / 2000), 2, 0.15);
}

TEST(LaneInvasion, IsCrossingThePaintBetweenLanes) {
    const world::TownT town = test::straight_road(400, 2);
    const world::LaneMap lanes(town);
    const auto crossed = [&](double from, double to) {
        const world::SealedTick last = test::tick_with({test::vehicle_at(1, 100, from)});
        const world::SealedTick tick = test::tick_with({test::vehicle_at(1, 101, to)});
        return render::lane_invasion_readings(
            last.view(), tick.view(), reader(SensorKind::lane_invasion), town, lanes);
    };
    const auto lane = [&](const char* name) {
        return static_cast<double>(*world::find_lane(town, name));
    };
    using testing::ElementsAre;
    EXPECT_THAT(crossed(-5.25, -5.2), testing::IsEmpty()) << "inside its lane";
    EXPECT_THAT(crossed(-5.25, -4.0), ElementsAre(ElementsAre(lane("east_1"), 0))) << "dashes";
    EXPECT_THAT(crossed(-1.75, -0.5), ElementsAre(ElementsAre(lane("east_2"), 1))) << "the middle";
    EXPECT_THAT(crossed(-5.25, -6.5), ElementsAre(ElementsAre(lane("east_1"), 2))) << "the edge";
}

TEST(Collision, TellsWhoAndHowHard) {
    world::TickDraft draft;
    draft.tick.vehicles = {test::vehicle_at(1, 0, 0)};
    for (const auto& [actor, other, value] :
         {std::tuple(1U, 7U, 900.0), {7U, 1U, 800.0}, {5U, 6U, 1.0}}) {
        auto event = std::make_unique<world::EventT>();
        event->kind = actor == 7 ? world::EventKind::collision_ended : world::EventKind::collision;
        event->actor = actor;
        event->other = other;
        event->value = value;
        event->position = world::Vec3(3, 4, 5);
        draft.tick.events.push_back(*event);
    }
    const world::SealedTick tick = world::seal(draft, {});
    EXPECT_THAT(render::collision_readings(tick.view(), reader(SensorKind::collision)),
                testing::ElementsAre(testing::ElementsAre(7, 900, 3, 4, 5, 0),
                                     testing::ElementsAre(7, 800, 3, 4, 5, 1)));
}

}  // namespace reprise
