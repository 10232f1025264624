#include "render/carried_camera.h"

#include <cmath>
#include <string>

#include "world/external/rig.h"
#include "world/external/sensor_attributes.h"
#include "world/models/viewpoint.h"

namespace reprise::render {

std::optional<Camera> find_camera(const world::TickView& tick,
                                  const world::SensorSpec& spec,
                                  const Eigen::Vector3d& origin) {
    std::optional<Eigen::Isometry3d> pose = Eigen::Isometry3d::Identity();
    if (spec.actor != 0)
        pose = world::find_pose(tick, spec.actor);
    if (!pose)
        return std::nullopt;
    pose->translation() -= origin;
    return Camera(spec, *pose);
}

Camera camera_of(const world::TickView& tick,
                 const world::SensorSpec& spec,
                 const Eigen::Vector3d& origin) {
    if (spec.width <= 0 || spec.height <= 0 || !(spec.fov > 0.001 && spec.fov < 3.5) ||
        !spec.position.allFinite() || !std::isfinite(spec.yaw) || !std::isfinite(spec.pitch) ||
        !std::isfinite(spec.roll))
        throw world::Error("sensor '" + spec.name +
                           "': size, field of view or place is not possible");
    if (const std::string why = world::contradiction(spec); !why.empty())
        throw world::Error("sensor '" + spec.name + "': " + why);
    const std::optional<Camera> camera = find_camera(tick, spec, origin);
    if (!camera)
        throw world::Error("sensor '" + spec.name + "': there is no actor " +
                           std::to_string(spec.actor) + " at tick " + std::to_string(tick.index()));
    return *camera;
}

std::uint32_t hidden_from(const world::TickView& tick, const world::SensorSpec& spec) {
    if (world::attribute(spec, "own_car") > 0)
        return 0;
    const std::optional<world::Extent> extent = world::find_extent(tick, spec.actor);
    return extent && world::is_carried_at(*extent, spec.position) ? spec.actor : 0;
}

}  // namespace reprise::render
