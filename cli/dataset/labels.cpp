#include "cli/dataset/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace reprise::cli {

namespace {

using Json = nlohmann::ordered_json;
using world::SemanticClass;

struct Category {
    SemanticClass tag;
    const char* coco;
    const char* kitti;
    double fill;  ///< share of its box that such a thing covers when nothing hides it
};

constexpr std::array categories{
    Category{SemanticClass::pedestrian, "pedestrian", "Pedestrian", 0.35},
    Category{SemanticClass::rider, "rider", "Cyclist", 0.45},
    Category{SemanticClass::car, "car", "Car", 0.7},
    Category{SemanticClass::truck, "truck", "Truck", 0.75},
    Category{SemanticClass::bus, "bus", "Misc", 0.8},
    Category{SemanticClass::motorcycle, "motorcycle", "Cyclist", 0.45},
    Category{SemanticClass::bicycle, "bicycle", "Cyclist", 0.4},
};

const Category* category_of(const Json& box) {
    for (const Category& one : categories)
        if (static_cast<int>(one.tag) == box["class"].get<int>())
            return &one;
    return nullptr;
}

Eigen::Isometry3d pose_of(const Json& rows) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            pose.matrix()(row, column) =
                rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].get<double>();
    return pose;
}

/// The share of its box in the picture's plane that lies outside of the picture.
double truncated(const Eigen::Isometry3d& pose_camera_box,
                 const Eigen::Vector3d& size,
                 const world::SensorSpec& camera) {
    constexpr double nearest = 0.1;  // [m] what is behind the camera lies far out
    const double focal = camera.width / 2.0 / std::tan(camera.fov / 2);
    Eigen::AlignedBox2d whole;
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d sign((corner & 1) != 0 ? 0.5 : -0.5,
                                   (corner & 2) != 0 ? 0.5 : -0.5,
                                   (corner & 4) != 0 ? 0.5 : -0.5);
        const Eigen::Vector3d p_camera = pose_camera_box * size.cwiseProduct(sign);
        const double depth = std::max(p_camera.z(), nearest);
        whole.extend(Eigen::Vector2d(camera.width / 2.0 + focal * p_camera.x() / depth,
                                     camera.height / 2.0 + focal * p_camera.y() / depth));
    }
    const Eigen::AlignedBox2d picture(Eigen::Vector2d::Zero(),
                                      Eigen::Vector2d(camera.width, camera.height));
    const Eigen::AlignedBox2d inside = whole.intersection(picture);
    const double share = inside.isEmpty() ? 0 : inside.volume() / whole.volume();
    return std::clamp(1 - share, 0.0, 1.0);
}

double share_of(const Json& box) {
    constexpr double of_things = 0.6;
    const Category* category = category_of(box);
    const double fill = category != nullptr ? category->fill : of_things;
    const auto at = [&](std::size_t i) { return box["box_whole"][i].get<double>(); };
    const double area = (at(2) - at(0)) * (at(3) - at(1));
    return box["pixels"].get<double>() / std::max(1.0, fill * area);
}

/// 0 whole, 1 partly, 2 largely hidden: by how many of the pixels that are expected show it.
int occluded(const Json& box) {
    const double shown = share_of(box);
    return shown > 0.75 ? 0 : shown > 0.35 ? 1 : 2;
}

/// Lengths of runs of pixels that are not of it and are, in turn, column by column.
Json run_lengths(const world::SensorFrame& instances, std::uint16_t number) {
    Json counts = Json::array();
    bool inside = false;
    std::size_t run = 0;
    for (int x = 0; x < instances.width; ++x)
        for (int y = 0; y < instances.height; ++y) {
            const auto at =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(instances.width) +
                static_cast<std::size_t>(x);
            std::uint16_t value = 0;
            std::memcpy(&value, instances.data.data() + 2 * at, sizeof(value));
            if ((value == number) != inside) {
                counts.push_back(run);
                run = 0;
                inside = !inside;
            }
            ++run;
        }
    counts.push_back(run);
    return counts;
}

}  // namespace

std::string kitti_labels(const std::string& boxes, const world::SensorSpec& camera) {
    std::string text;
    const Json json = Json::parse(boxes);
    for (const Json& box : json["boxes"]) {
        const Category* category = category_of(box);
        if (category == nullptr)
            continue;
        const Eigen::Vector3d size(box["size"][0].get<double>(),
                                   box["size"][1].get<double>(),
                                   box["size"][2].get<double>());
        const Eigen::Isometry3d pose = pose_of(box["camera_from_box"]);
        const Eigen::Vector3d ahead = pose.linear().col(0);
        // KITTI's place is the middle of the underside; angles turn from x to -z.
        const Eigen::Vector3d place = pose * Eigen::Vector3d(0, 0, -size.z() / 2);
        const double yaw = std::atan2(-ahead.z(), ahead.x());
        const double alpha =
            std::remainder(yaw - std::atan2(place.x(), place.z()), 2 * std::numbers::pi);
        const Json& seen = box["box_seen"];
        text += fmt::format(
            "{} {:.2f} {} {:.4f} {:.2f} {:.2f} {:.2f} {:.2f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} "
            "{:.3f} {:.4f}\n",
            category->kitti,
            truncated(pose, size, camera),
            occluded(box),
            alpha,
            seen[0].get<double>(),
            seen[1].get<double>(),
            seen[2].get<double>(),
            seen[3].get<double>(),
            size.z(),
            size.y(),
            size.x(),
            place.x(),
            place.y(),
            place.z(),
            yaw);
    }
    return text;
}

std::string coco_annotations(const std::string& boxes, const world::SensorFrame& instances) {
    Json all = Json::array();
    const Json json = Json::parse(boxes);
    for (const Json& box : json["boxes"]) {
        if (category_of(box) == nullptr)
            continue;
        const auto at = [&](std::size_t i) { return box["box_seen"][i].get<double>(); };
        Json& one = all.emplace_back();
        one["category_id"] = box["class"];
        one["bbox"] = {at(0), at(1), at(2) - at(0), at(3) - at(1)};
        one["area"] = box["pixels"];
        one["iscrowd"] = 0;
        one["segmentation"] = {
            {"size", {instances.height, instances.width}},
            {"counts", run_lengths(instances, box["instance"].get<std::uint16_t>())}};
        one["actor"] = box["actor"];
        if (box.contains("thing"))
            one["thing"] = box["thing"];
    }
    return all.dump() + "\n";
}

double shown_share(const std::string& box) {
    return share_of(Json::parse(box));
}

std::string coco_categories() {
    Json all = Json::array();
    for (const Category& one : categories)
        all.push_back({{"id", static_cast<int>(one.tag)},
                       {"name", one.coco},
                       {"supercategory", one.tag < SemanticClass::car ? "person" : "vehicle"}});
    return all.dump();
}

}  // namespace reprise::cli
