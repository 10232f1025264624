#include <cmath>
#include <numbers>

#include "render/readings/mounted.h"
#include "render/readings/readings.h"
#include "world/external/sensor_attributes.h"
#include "world/external/sensor_noise.h"
#include "world/frames.h"
#include "world/models/actors.h"
#include "world/models/car_model.h"

namespace reprise::render {

using Eigen::Vector3d;

namespace {

/// Of the carrier's origin, mean over the tick. World frame.
Vector3d acceleration_of(const world::TickView* last,
                         const world::TickView& tick,
                         const world::SensorSpec& spec,
                         const Twist& now) {
    if (const world::VehicleState* vehicle = world::find(tick.vehicles(), spec.actor))
        return world::to_eigen(vehicle->acceleration());
    // Without mass: as its velocity changed.
    const auto before = last != nullptr ? find_twist(*last, spec.actor) : std::nullopt;
    return before ? Vector3d((now.velocity - before->velocity) / spec.step) : Vector3d::Zero();
}

/// What is without mass has no rate of turning in the tick: as its heading changed.
Vector3d turning_of(const world::TickView* last,
                    const world::TickView& tick,
                    const world::SensorSpec& spec,
                    const Twist& now) {
    if (world::find(tick.vehicles(), spec.actor) != nullptr || last == nullptr)
        return now.turning;
    const auto here = world::find_pose(tick, spec.actor);
    const auto there = world::find_pose(*last, spec.actor);
    if (!here || !there)
        return now.turning;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(here->linear() * there->linear().transpose()));
    return turn.axis() * (turn.angle() / spec.step);
}

/// [rad] from north (y), clockwise, in [0, 2 pi).
double heading_of(const Vector3d& ahead) {
    const double angle = std::atan2(ahead.x(), ahead.y());
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

}  // namespace

world::Reading imu_reading(const world::TickView* last,
                           const world::TickView& tick,
                           const world::SensorSpec& spec) {
    const Mounted own = mounted(tick, spec);
    const Vector3d turning = turning_of(last, tick, spec, own.twist);
    const Vector3d arm = own.pose_world_sensor.translation() - own.twist.origin;
    Vector3d turning_faster = Vector3d::Zero();
    if (last != nullptr)
        if (const world::VehicleState* before = world::find(last->vehicles(), spec.actor))
            turning_faster = (turning - world::to_eigen(before->angular_velocity())) / spec.step;
    const Vector3d up(0, 0, world::gravity);
    Vector3d acceleration = acceleration_of(last, tick, spec, own.twist);
    if (spec.actor != 0)
        acceleration += turning.cross(turning.cross(arm)) + turning_faster.cross(arm);
    const Eigen::Matrix3d to_sensor = own.pose_world_sensor.linear().transpose();
    const Vector3d felt = to_sensor * (acceleration + up);
    const Vector3d turned = to_sensor * turning;

    const auto value = [&](const std::string& name) { return world::attribute(spec, name); };
    const world::SensorNoise noise(
        static_cast<std::uint64_t>(value("noise_seed")), spec.name, tick.index());
    world::Reading reading;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const std::string name(1, "xyz"[axis]);
        reading.push_back(felt[axis] + value("noise_accel_stddev_" + name) * noise.normal(0, axis));
    }
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const std::string name(1, "xyz"[axis]);
        reading.push_back(turned[axis] + value("noise_gyro_bias_" + name) +
                          value("noise_gyro_stddev_" + name) * noise.normal(0, 3 + axis));
    }
    reading.push_back(heading_of(own.pose_world_sensor.linear().col(0)));
    return reading;
}

}  // namespace reprise::render
