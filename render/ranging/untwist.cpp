#include "render/ranging/untwist.h"

#include <algorithm>
#include <cstring>

#include "render/ranging/mount.h"
#include "world/external/point_fields.h"
#include "world/external/sensor_attributes.h"

namespace reprise::render {

void untwist(world::SensorFrame& frame,
             const world::TickView& tick,
             const world::SensorSpec& spec) {
    const auto fields = world::point_fields(frame.kind);
    const auto time = std::find_if(fields.begin(), fields.end(), [](const world::PointField& one) {
        return one.name == "time";
    });
    if (time == fields.end() || world::attribute(spec, "rolling") < 0.5)
        return;
    const Mount mount(tick, spec, Eigen::Vector3d::Zero());
    const Eigen::Isometry3d pose_sensor_world = mount.pose().inverse();
    const auto when = static_cast<std::size_t>(time - fields.begin());
    float last = 0;
    Eigen::Isometry3d pose_now_then = Eigen::Isometry3d::Identity();
    for (std::size_t row = 0; row < static_cast<std::size_t>(frame.height); ++row) {
        std::uint8_t* bytes = frame.data.data() + row * fields.size() * sizeof(float);
        float seconds = 0;
        std::memcpy(&seconds, bytes + when * sizeof(float), sizeof(seconds));
        if (seconds != last)  // a column of shots has one instant
            pose_now_then = pose_sensor_world * mount.pose(-static_cast<double>(seconds));
        last = seconds;
        Eigen::Vector3f point;
        std::memcpy(point.data(), bytes, sizeof(point));
        const Eigen::Vector3f moved = (pose_now_then * point.cast<double>()).cast<float>();
        std::memcpy(bytes, moved.data(), sizeof(moved));
    }
}

}  // namespace reprise::render
