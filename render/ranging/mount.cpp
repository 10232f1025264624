#include "render/ranging/mount.h"

#include <string>

#include "world/check.h"
#include "world/external/mounting.h"
#include "world/models/viewpoint.h"

namespace reprise::render {

Mount::Mount(const world::TickView& tick,
             const world::SensorSpec& spec,
             const Eigen::Vector3d& origin)
    : origin_(origin),
      pose_world_sensor_(world::pose_in_mount(spec)) {
    if (spec.actor == 0)
        return;
    const auto pose_world_actor = world::find_pose(tick, spec.actor);
    if (!pose_world_actor)
        throw world::Error("sensor '" + spec.name + "': there is no actor " +
                           std::to_string(spec.actor) + " at tick " + std::to_string(tick.index()));
    pose_world_sensor_ = *pose_world_actor * pose_world_sensor_;
    twist_ = find_twist(tick, spec.actor).value_or(Twist());
    const auto extent = world::find_extent(tick, spec.actor);
    if (extent && world::is_carried_at(*extent, spec.position))
        hidden_ = spec.actor;
}

Eigen::Isometry3d Mount::pose(double ago) const {
    return Eigen::Translation3d(-origin_) * twist_.back(ago) * pose_world_sensor_;
}

Eigen::Vector3d Mount::velocity() const {
    return twist_.velocity_at(pose_world_sensor_.translation());
}

}  // namespace reprise::render
