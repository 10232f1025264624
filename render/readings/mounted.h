#pragma once

#include "render/ranging/mount.h"

namespace reprise::render {

/// A sensor in the world, and who carries it.
struct Mounted {
    Eigen::Isometry3d pose_world_sensor;
    Twist twist;  ///< of the carrier; nobody's does not move
};

/// Throws world::Error when the actor is not there.
inline Mounted mounted(const world::TickView& tick, const world::SensorSpec& spec) {
    const Mount mount(tick, spec, Eigen::Vector3d::Zero());
    return {mount.pose(), find_twist(tick, spec.actor).value_or(Twist())};
}

}  // namespace reprise::render
