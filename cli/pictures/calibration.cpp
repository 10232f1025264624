#include "cli/pictures/calibration.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "files/output_file.h"
#include "render/trace/camera.h"
#include "world/external/mounting.h"
#include "world/external/sensor_attributes.h"

namespace reprise::cli {

namespace {

using Json = nlohmann::ordered_json;
using Rows = Eigen::Matrix<double, 3, 4>;

/// From the carrier's frame to the camera's.
Rows into_camera(const render::Camera& camera) {
    Rows rows;
    rows.leftCols<3>() = camera.rotation_scene_camera().transpose();
    rows.col(3) = -(rows.leftCols<3>() * camera.position());
    return rows;
}

Rows projection(const render::Camera& camera) {
    Rows rows = Rows::Zero();
    rows(0, 0) = camera.focal();
    rows(1, 1) = camera.focal_y();
    rows(0, 2) = camera.middle().x();
    rows(1, 2) = camera.middle().y();
    rows(2, 2) = 1;
    return rows;
}

Json nested(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
    Json rows = Json::array();
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
        Json& line = rows.emplace_back(Json::array());
        for (Eigen::Index column = 0; column < matrix.cols(); ++column)
            line.push_back(matrix(row, column));
    }
    return rows;
}

std::string line_of(const char* name, const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
    std::string line = std::string(name) + ":";
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
        for (Eigen::Index column = 0; column < matrix.cols(); ++column)
            line += fmt::format(" {:.12e}", matrix(row, column));
    return line + "\n";
}

/// As they were said; all others are as usual.
Json attributes_of(const world::SensorSpec& sensor) {
    Json said = Json::object();
    for (const world::AttributeValue& one : sensor.attributes) {
        const std::vector<std::string> words =
            world::words_of(*world::find_attribute(sensor.kind, one.name));
        if (words.empty())
            said[one.name] = one.value;
        else
            said[one.name] = words.at(static_cast<std::size_t>(one.value));
    }
    return said;
}

/// As KITTI's raw data have it for cameras that are not rectified; its devkit looks past them.
std::string lens_lines(const render::Camera& camera) {
    const std::vector<double> d = camera.lens().coefficients();
    return line_of("K_02", projection(camera).leftCols<3>()) +
           line_of(
               camera.lens().is_fisheye() ? "D_02_fisheye" : "D_02",
               Eigen::Map<const Eigen::RowVectorXd>(d.data(), static_cast<Eigen::Index>(d.size())));
}

}  // namespace

void write_calibration(const std::filesystem::path& folder,
                       const world::SensorSpec& sensor,
                       const std::string& carrier) {
    constexpr double degrees = 180 / std::numbers::pi;
    const render::Camera camera(sensor, Eigen::Isometry3d::Identity());
    const Rows to_camera = into_camera(camera);
    Json json;
    json["name"] = sensor.name;
    json["type"] = world::EnumNameSensorKind(sensor.kind);
    json["size"] = {sensor.width, sensor.height};
    json["fov_deg"] = sensor.fov * degrees;
    json["intrinsics"] = nested(projection(camera).leftCols<3>());
    json["model"] = camera.lens().is_fisheye() ? "fisheye" : "pinhole";
    json["distortion_coefficients"] = camera.lens().coefficients();
    json["attributes"] = attributes_of(sensor);
    json["mounted_on"] = carrier;
    json["position"] = {sensor.position.x(), sensor.position.y(), sensor.position.z()};
    json["roll_deg"] = sensor.roll * degrees;
    json["pitch_deg"] = sensor.pitch * degrees;
    json["yaw_deg"] = sensor.yaw * degrees;
    Eigen::Matrix4d whole = Eigen::Matrix4d::Identity();
    whole.topRows<3>() = to_camera;
    json["camera_from_mount"] = nested(whole);
    files::write_file(folder / "camera.json", "the calibration", json.dump(2) + "\n");

    files::write_file(folder / "calib.txt", "the calibration", kitti_calibration(sensor));
}

std::string kitti_calibration(const world::SensorSpec& sensor, const world::SensorSpec* velodyne) {
    const render::Camera camera(sensor, Eigen::Isometry3d::Identity());
    const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
    const Eigen::Isometry3d pose_mount_velodyne =
        velodyne == nullptr ? Eigen::Isometry3d::Identity() : world::pose_in_mount(*velodyne);
    Eigen::Isometry3d pose_camera_mount = Eigen::Isometry3d::Identity();
    pose_camera_mount.matrix().topRows<3>() = into_camera(camera);
    const auto rows = [](const Eigen::Isometry3d& pose) {
        return Rows(pose.matrix().topRows<3>());
    };
    std::string kitti;
    for (const char* name : {"P0", "P1", "P2", "P3"})
        kitti += line_of(name, projection(camera));
    kitti += line_of("R0_rect", upright) +
             line_of("Tr_velo_to_cam", rows(pose_camera_mount * pose_mount_velodyne)) +
             line_of("Tr_imu_to_velo", rows(pose_mount_velodyne.inverse()));
    if (!camera.lens().is_plain())
        kitti += lens_lines(camera);
    return kitti;
}

}  // namespace reprise::cli
