#include "walkers/things.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "world/models/catalogue.h"

namespace reprise::walkers {
namespace {

void put(world::TickDraft& tick, float yaw, float speed, std::uint16_t model) {
    tick.traffic.cars.emplace_back(world::Vec3(0, 0, 0),
                                   yaw,
                                   0.0F,
                                   speed,
                                   0.0F,
                                   7U,
                                   world::none,
                                   model,
                                   std::uint16_t{0},
                                   0.0F);
}

/// The bodies of a car whose rear axle drives east through the origin.
std::vector<Body> bodies_of(std::uint16_t model, float turned, float speed, double step) {
    world::TickDraft before;
    world::TickDraft now;
    put(before, 0, speed, model);
    put(now, turned, speed, model);
    RoadUsers users;
    users.look(world::seal(before, {}).view(), step);
    const world::SealedTick last = world::seal(now, {});
    users.look(last.view(), step);
    Neighbours neighbours;
    const Eigen::Vector2d somebody(0, -3);
    Places places;
    places.add(somebody);
    add_things(last.view(), users.all(), places, places, neighbours);
    neighbours.sort();
    std::vector<Body> found;
    neighbours.around({somebody, {0, 0}, 0.25, 1}, 30, {.cars = true}, found);
    return found;
}

TEST(Things, TheTailOfABusThatTurnsComesSideways) {
    const std::uint16_t bus = world::find_vehicle_model("bus").value();
    constexpr float turned = 0.02F;
    constexpr double step = 0.05;
    std::vector<Body> bodies = bodies_of(bus, turned, 5, step);
    ASSERT_GT(bodies.size(), 4U);
    for (const Body& body : bodies) {
        // Turning left, what is behind the axle goes to the right; a tick later it has turned
        // twice.
        const double once = turned;
        const double axle = 5 * step * std::cos(once);
        EXPECT_NEAR(body.velocity.y(),
                    5 * std::sin(2 * once) + once / step * (body.place.x() - axle),
                    1e-6);
    }
    const auto tail =
        std::min_element(bodies.begin(), bodies.end(), [](const Body& one, const Body& other) {
            return one.place.x() < other.place.x();
        });
    EXPECT_LT(tail->velocity.y(), -0.8);
    EXPECT_NEAR(bodies_of(bus, 0, 5, step).back().velocity.y(), 0, 1e-9);
}

TEST(Things, ABusDoesNotLookOutBetweenItsBodies) {
    const std::uint16_t model = world::find_vehicle_model("bus").value();
    const world::VehicleModel& bus = world::vehicle_models()[model];
    const std::vector<Body> bodies = bodies_of(model, 0, 5, 0.05);
    for (double x = -bus.rear_overhang + 1; x < bus.length - bus.rear_overhang - 1; x += 0.05) {
        const Eigen::Vector2d side(x, -bus.width / 2);
        EXPECT_TRUE(std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
            return (body.place - side).norm() <= body.radius + 1e-9;
        })) << x;
    }
}

}  // namespace
}  // namespace reprise::walkers
