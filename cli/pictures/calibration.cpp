#include "cli/pictures/calibration.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "files/output_file.h"
#include "render/trace/camera.h"

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
    rows(0, 0) = rows(1, 1) = camera.focal();
    rows(0, 2) = camera.width() / 2.0;
    rows(1, 2) = camera.height() / 2.0;
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
    json["mounted_on"] = carrier;
    json["position"] = {sensor.position.x(), sensor.position.y(), sensor.position.z()};
    json["roll_deg"] = sensor.roll * degrees;
    json["pitch_deg"] = sensor.pitch * degrees;
    json["yaw_deg"] = sensor.yaw * degrees;
    Eigen::Matrix4d whole = Eigen::Matrix4d::Identity();
    whole.topRows<3>() = to_camera;
    json["camera_from_mount"] = nested(whole);
    files::write_file(folder / "camera.json", "the calibration", json.dump(2) + "\n");

    const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
    std::string kitti;
    for (const char* name : {"P0", "P1", "P2", "P3"})
        kitti += line_of(name, projection(camera));
    kitti += line_of("R0_rect", upright) + line_of("Tr_velo_to_cam", to_camera);
    files::write_file(folder / "calib.txt", "the calibration", kitti);
}

}  // namespace reprise::cli
