// Learning starts with drivers who press pedals at random. Whatever they do, the car stays one.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "tests/kernel/physics/physics_rig.h"
#include "tests/support/towns.h"
#include "world/frames.h"
#include "world/models/car_model.h"
#include "world/models/catalogue.h"
#include "world/random.h"

namespace reprise::kernel {
namespace {

constexpr int blind_ticks = 400;
constexpr int braked_ticks = 240;
constexpr std::uint64_t held = 10;  // [ticks] a control

enum class Manner { at_random, straight_on, left, right, backwards, flat_out, count };

world::Control blind(Manner manner, std::uint64_t drive, int tick) {
    const auto draw = [&](std::uint64_t item) {
        return world::draw(
            drive, static_cast<std::uint64_t>(tick) / held, world::Purpose::scenario, item);
    };
    const double steer = 2 * draw(0) - 1;
    switch (manner) {
        case Manner::straight_on:
            return test::drive(1, 0);
        case Manner::left:
            return test::drive(1, 0, 1);
        case Manner::right:
            return test::drive(1, 0, -1);
        case Manner::backwards:
            return {1, 0, 0, 1, 0, false, true};
        case Manner::flat_out:
            return test::drive(1, 0, steer);
        default:
            return {
                draw(1), draw(2) < 0.2 ? draw(3) : 0, steer, 1, 0, draw(4) < 0.1, draw(5) < 0.3};
    }
}

const world::VehicleModel& sedan_in_catalogue() {
    return world::vehicle_models()[world::find_vehicle_model("sedan").value()];
}

/// Of motion and height. [J]
double energy_of(const world::CarModel& car, const world::VehicleState& state) {
    const Eigen::Matrix3d turn = world::to_eigen(state.orientation()).toRotationMatrix();
    const Eigen::Vector3d arm = turn * Eigen::Vector3d(car.com_ahead, 0, car.com_height);
    const Eigen::Vector3d spin = world::to_eigen(state.angular_velocity());
    const Eigen::Vector3d velocity = world::to_eigen(state.velocity()) + spin.cross(arm);
    const Eigen::Vector3d spin_in_body = turn.transpose() * spin;
    const double mass = car.catalogue->mass;
    return mass * velocity.squaredNorm() / 2 +
           spin_in_body.dot(car.inertia.cwiseProduct(spin_in_body)) / 2 +
           mass * world::gravity * (state.position().z() + arm.z());
}

bool is_finite(const world::VehicleState& state) {
    return world::to_eigen(state.position()).allFinite() &&
           world::to_eigen(state.velocity()).allFinite() &&
           world::to_eigen(state.angular_velocity()).allFinite() &&
           std::abs(world::to_eigen(state.orientation()).norm() - 1) < 1e-9;
}

/// A town's ground with one car, which starts anew for every drive.
class Drives {
  public:
    explicit Drives(const world::TownT& town)
        : town_(town),
          mesh_(ground::build_ground(town)),
          world_(mesh_, town) {
        for (const Eigen::Vector3d& v : mesh_.vertices) {
            lowest_ = std::min(lowest_, v.z());
            highest_ = std::max(highest_, v.z());
        }
    }

    /// Blind at first, then braked until it stands; looks at every tick.
    void drive(std::uint64_t number) {
        start(number);
        const auto manner = static_cast<Manner>(number % static_cast<int>(Manner::count));
        for (int tick = 0; tick < blind_ticks && !testing::Test::HasFailure(); ++tick)
            look(world_.step(blind(manner, number, tick)), number);
        for (int tick = 0; tick < braked_ticks && !testing::Test::HasFailure(); ++tick)
            look(world_.step(test::drive(0, 1)), number);
        EXPECT_LT(world::to_eigen(world_.vehicle().velocity()).norm(), 0.05) << "drive " << number;
        EXPECT_LT(world::to_eigen(world_.vehicle().angular_velocity()).norm(), 0.05)
            << "drive " << number;
    }

    std::size_t hits = 0;  ///< ticks with a touch

  private:
    void start(std::uint64_t number) {
        if (number > 0)
            world_.physics().remove_vehicle(1);
        const std::size_t point =
            world::draw_index(town_.spawn_points.size(), number, 0, world::Purpose::scenario, 9);
        const world::SpawnPoint& at = town_.spawn_points[point];
        world_.add_vehicle("sedan", 0, at.position().x(), at.position().y(), at.yaw());
        last_energy_ = 1e9;
    }

    void look(const world::VehicleState& state, std::uint64_t number) {
        ASSERT_TRUE(is_finite(state)) << "drive " << number;
        // On the ground, or thrown over by a kerb or a wall; on its roof its origin is on top.
        EXPECT_GT(state.position().z(), lowest_ - 0.5) << "drive " << number;
        EXPECT_LT(state.position().z(), highest_ + 4) << "drive " << number;
        EXPECT_LT(world::to_eigen(state.velocity()).norm(), top_speed_) << "drive " << number;
        // Nothing but the engine and the springs gives it energy: no contact explodes.
        const double energy = energy_of(car_, state);
        EXPECT_LT(energy - last_energy_, car_.catalogue->power * test::tick_seconds + from_springs)
            << "drive " << number;
        last_energy_ = energy;
        hits += world_.physics().impacts().size();
    }

    static constexpr double from_springs = 3000;  ///< [J] four of them, fully pressed

    const world::TownT& town_;
    ground::GroundMesh mesh_;
    test::ProvingGround world_;
    world::CarModel car_ = world::car_model(sedan_in_catalogue());
    double top_speed_ =
        std::cbrt(car_.catalogue->power / (0.5 * world::air_density * car_.catalogue->drag_area));
    double lowest_ = 1e9;
    double highest_ = -1e9;
    double last_energy_ = 0;
};

class BlindDriver : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Towns, BlindDriver, testing::Values("town1", "town2"), [](const auto& t) {
    return std::string(t.param);
});

TEST_P(BlindDriver, NeitherFliesNorSinksNorGainsSpeedFromWhatItHits) {
    Drives drives(test::own_town(GetParam()).town);
    for (std::uint64_t number = 0; number < 24 && !HasFailure(); ++number)
        drives.drive(number);
    EXPECT_GT(drives.hits, 1000U);
}

}  // namespace
}  // namespace reprise::kernel
