#include "cli/pictures/box_text.h"

#include <nlohmann/json.hpp>

#include "world/check.h"
#include "world/models/actors.h"

namespace reprise::cli {

namespace {

using Json = nlohmann::ordered_json;

Json numbers(const render::PixelBox& box) {
    return {box.left, box.top, box.right, box.bottom};
}

Json numbers(const Eigen::Vector3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

Json numbers(const Eigen::Isometry3d& pose) {
    Json rows = Json::array();
    for (int row = 0; row < 4; ++row)
        rows.push_back({pose(row, 0), pose(row, 1), pose(row, 2), pose(row, 3)});
    return rows;
}

}  // namespace

std::string box_text(const world::TickView& tick,
                     std::span<const render::ParkedVehicle> parked,
                     const world::SensorSpec& camera,
                     const world::SensorFrame& instances,
                     const world::SensorFrame& classes) {
    Eigen::Isometry3d pose_world_mount = Eigen::Isometry3d::Identity();
    if (camera.actor != 0) {
        const auto found = world::find_pose(tick, camera.actor);
        REPRISE_CHECK(found.has_value(), camera.name);
        pose_world_mount = *found;
    }
    const render::Camera eye(camera, pose_world_mount);
    Eigen::Isometry3d pose_world_camera = Eigen::Isometry3d::Identity();
    pose_world_camera.linear() = eye.rotation_scene_camera();
    pose_world_camera.translation() = eye.position();
    Json json;
    json["tick"] = tick.index();
    json["sensor"] = camera.name;
    json["world_from_camera"] = numbers(pose_world_camera);
    json["boxes"] = Json::array();
    for (const render::LabelBox& box : render::boxes_of(tick, parked, eye, instances, classes)) {
        Json& one = json["boxes"].emplace_back();
        one["actor"] = box.actor;
        if (box.thing)
            one["thing"] = *box.thing;
        one["instance"] = box.instance;
        one["class"] = static_cast<int>(box.what);
        one["pixels"] = box.pixels;
        one["box_seen"] = numbers(box.seen);
        one["box_whole"] = numbers(box.whole);
        one["size"] = numbers(box.size);
        one["camera_from_box"] = numbers(box.pose_camera);
    }
    return json.dump(1) + "\n";
}

}  // namespace reprise::cli
