#include "cli/dataset/nuscenes_annotations.h"

#include <algorithm>

#include "cli/dataset/nuscenes_names.h"
#include "cli/dataset/nuscenes_points.h"

namespace reprise::cli {

namespace {

using Json = nlohmann::ordered_json;

/// Places in the world that points of one kind of sensor have.
std::vector<Eigen::Vector3d> places(const NuscenesContent& content,
                                    const std::string& weather,
                                    std::size_t id,
                                    bool radars) {
    std::vector<Eigen::Vector3d> all;
    for (const NuscenesChannel& channel : content.channels) {
        const bool counts = radars ? channel.modality == "radar"
                                   : !channel.camera && channel.number == content.layout.velodyne();
        if (!counts)
            continue;
        const Eigen::Isometry3d pose = content.frames[id].pose_world_ego * channel.pose_ego;
        for (const Eigen::Vector3f& point :
             read_nuscenes_places(content.layout.points(channel.number, weather, id)))
            all.push_back(pose * point.cast<double>());
    }
    return all;
}

std::size_t count_inside(const NuscenesObject& object, const std::vector<Eigen::Vector3d>& points) {
    const Eigen::Isometry3d into_box = object.pose_world.inverse();
    const Eigen::Vector3d half = object.size / 2;
    const double reach = half.squaredNorm();
    return static_cast<std::size_t>(
        std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
            return (p - object.pose_world.translation()).squaredNorm() <= reach &&
                   ((into_box * p).cwiseAbs().array() <= half.array()).all();
        }));
}

}  // namespace

Json json_of(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

Json json_of(const Eigen::Matrix3d& rotation) {
    const Eigen::Quaterniond q(rotation);
    return {q.w(), q.x(), q.y(), q.z()};
}

void add_annotations(const NuscenesContent& content,
                     const std::string& weather,
                     NuscenesTables& tables) {
    /// The last annotation of an actor of a scene, by its row, and the row of its instance.
    struct Track {
        std::size_t annotation = 0;
        std::size_t instance = 0;
    };

    Json& annotations = tables["sample_annotation"] = Json::array();
    Json& instances = tables["instance"] = Json::array();
    std::map<std::pair<std::size_t, std::uint32_t>, Track> tracks;
    for (std::size_t id = 0; id < content.frames.size(); ++id) {
        const std::vector<Eigen::Vector3d> lidar = places(content, weather, id, false);
        const std::vector<Eigen::Vector3d> radar = places(content, weather, id, true);
        for (const NuscenesObject& object : content.frames[id].objects) {
            const std::size_t scene = content.scene_of[id];
            const std::string own = content.annotation(id, object.actor);
            const auto [track, fresh] = tracks.try_emplace({scene, object.actor});
            if (fresh) {
                track->second.instance = instances.size();
                instances.push_back(
                    {{"token", content.instance(scene, object.actor)},
                     {"category_token", tables["category"][object.category]["token"]},
                     {"nbr_annotations", 0},
                     {"first_annotation_token", own},
                     {"last_annotation_token", own}});
            }
            Json& instance = instances[track->second.instance];
            instance["nbr_annotations"] = instance["nbr_annotations"].get<int>() + 1;
            instance["last_annotation_token"] = own;
            std::string before;
            if (!fresh) {
                Json& last = annotations[track->second.annotation];
                before = last["token"].get<std::string>();
                last["next"] = own;
            }
            track->second.annotation = annotations.size();
            Json attributes = Json::array();
            if (object.attribute)
                attributes.push_back(tables["attribute"][*object.attribute]["token"]);
            annotations.push_back(
                {{"token", own},
                 {"sample_token", content.sample(id)},
                 {"instance_token", instance["token"]},
                 {"visibility_token", nuscenes_visibility(object.share)},
                 {"attribute_tokens", attributes},
                 {"translation", json_of(content.place(id, object.pose_world))},
                 {"size", {object.size.y(), object.size.x(), object.size.z()}},
                 {"rotation", json_of(Eigen::Matrix3d(object.pose_world.linear()))},
                 {"prev", before},
                 {"next", ""},
                 {"num_lidar_pts", count_inside(object, lidar)},
                 {"num_radar_pts", count_inside(object, radar)}});
        }
    }
}

}  // namespace reprise::cli
