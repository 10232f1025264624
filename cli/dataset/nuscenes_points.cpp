#include "cli/dataset/nuscenes_points.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "files/json_text.h"
#include "render/ranging/mount.h"
#include "world/check.h"
#include "world/external/point_fields.h"
#include "world/external/sensor_attributes.h"

namespace reprise::cli {

namespace {

template <typename Number>
void put(std::string& bytes, Number value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// PointRows of 32-bit columns, which are real or whole.
class PointRows {
  public:
    explicit PointRows(const world::SensorFrame& frame)
        : frame_(frame),
          columns_(world::point_fields(frame.kind).size()) {}

    std::size_t count() const { return static_cast<std::size_t>(frame_.height); }

    float real(std::size_t row, std::size_t column) const { return at<float>(row, column); }

    std::uint32_t whole(std::size_t row, std::size_t column) const {
        return at<std::uint32_t>(row, column);
    }

  private:
    template <typename Number>
    Number at(std::size_t row, std::size_t column) const {
        Number value = 0;
        std::memcpy(&value, frame_.data.data() + (row * columns_ + column) * 4, sizeof(value));
        return value;
    }

    const world::SensorFrame& frame_;
    std::size_t columns_;
};

constexpr std::size_t sweep_bytes = 5 * sizeof(float);
constexpr std::size_t detection_bytes = 43;

/// Its states are those of a radar that is sure of what it says.
void put_detection(std::string& bytes,
                   const Eigen::Vector3f& place,
                   std::int16_t id,
                   float rcs,
                   const Eigen::Vector2f& velocity,
                   const Eigen::Vector2f& over_ground) {
    enum Moves : std::int8_t { moving = 0, stationary = 1, oncoming = 2 };

    constexpr std::int8_t valid = 1;
    constexpr std::int8_t unambiguous = 3;
    constexpr std::int8_t below_a_quarter = 1;  // its chance of being false
    constexpr float slow = 0.5F;                // [m/s]
    const bool nears = over_ground.dot(place.head<2>()) < 0;
    for (const float value : place)
        put(bytes, value);
    put(bytes, over_ground.norm() < slow ? stationary : nears ? oncoming : moving);
    put(bytes, id);
    for (const float value : {rcs, velocity.x(), velocity.y(), over_ground.x(), over_ground.y()})
        put(bytes, value);
    for (const std::int8_t state : {valid, unambiguous})
        put(bytes, state);
    for (const std::int8_t state :
         std::initializer_list<std::int8_t>{0, 0, 0, below_a_quarter, 0, 0})
        put(bytes, state);  // x_rms y_rms invalid_state pdh0 vx_rms vy_rms
}

std::string detection_header(std::size_t count) {
    return fmt::format(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
        "FIELDS x y z dyn_prop id rcs vx vy vx_comp vy_comp is_quality_valid ambig_state x_rms "
        "y_rms invalid_state pdh0 vx_rms vy_rms\n"
        "SIZE 4 4 4 1 2 4 4 4 4 4 1 1 1 1 1 1 1 1\nTYPE F F F I I F F F F F I I I I I I I I\n"
        "COUNT 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\nWIDTH {}\nHEIGHT 1\n"
        "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
        count,
        count);
}

bool is_vehicle(std::uint32_t tag) {
    using enum world::SemanticClass;
    const auto what = static_cast<world::SemanticClass>(tag);
    return what == car || what == truck || what == bus || what == motorcycle || what == bicycle;
}

/// Whose box a place is in, or nearest to: mirrors and wheels stand out of it. Null: nobody's.
const render::ParkedVehicle* owner_of(const Eigen::Vector3d& p_world,
                                      std::span<const render::ParkedVehicle> parked) {
    const render::ParkedVehicle* owner = nullptr;
    double least = 0.5;  // [m]
    for (const render::ParkedVehicle& one : parked) {
        const Eigen::Vector3d p_box = one.box.pose_world.inverse() * p_world;
        const double away = (p_box.cwiseAbs() - one.box.size / 2).cwiseMax(0).norm();
        if (away < least) {
            least = away;
            owner = &one;
        }
    }
    return owner;
}

}  // namespace

Eigen::Isometry3d pose_sensor_nuscenes_lidar() {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() << 0, 1, 0, -1, 0, 0, 0, 0, 1;
    return pose;
}

std::string nuscenes_sweep(const world::SensorFrame& frame, const world::SensorSpec& lidar) {
    enum Column : std::size_t { x, y, z, intensity, time, ring };

    const PointRows rows(frame);
    const auto last = static_cast<std::uint32_t>(world::attribute(lidar, "channels")) - 1;
    std::string bytes;
    bytes.reserve(rows.count() * sweep_bytes);
    for (std::size_t i = 0; i < rows.count(); ++i)
        for (const float value : {-rows.real(i, y),
                                  rows.real(i, x),
                                  rows.real(i, z),
                                  255 * rows.real(i, intensity),
                                  static_cast<float>(last - rows.whole(i, ring))})
            put(bytes, value);
    return bytes;
}

std::string nuscenes_detections(const world::SensorFrame& frame,
                                const world::TickView& tick,
                                const world::SensorSpec& placed) {
    enum Column : std::size_t { velocity, azimuth, altitude, depth, snr, rcs };

    const render::Mount mount(tick, placed, Eigen::Vector3d::Zero());
    const Eigen::Vector3d own = mount.pose().linear().transpose() * mount.velocity();
    const PointRows rows(frame);
    std::string bytes = detection_header(std::max<std::size_t>(1, rows.count()));
    for (std::size_t i = 0; i < rows.count(); ++i) {
        const auto turn = static_cast<double>(rows.real(i, azimuth));
        const auto up = static_cast<double>(rows.real(i, altitude));
        const Eigen::Vector3d way(
            std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
        const auto away = static_cast<double>(rows.real(i, velocity));
        put_detection(bytes,
                      (static_cast<double>(rows.real(i, depth)) * way).cast<float>(),
                      static_cast<std::int16_t>(i),
                      rows.real(i, rcs),
                      (away * way.head<2>()).cast<float>(),
                      ((away + own.dot(way)) * way.head<2>()).cast<float>());
    }
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    if (rows.count() == 0)  // as nuScenes says that nothing was found
        put_detection(bytes, {none, none, none}, 0, none, {none, none}, {none, none});
    return bytes + '\n';  // its devkit looks for a byte behind the last one
}

std::vector<Eigen::Vector3f> read_nuscenes_places(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const bool radar = path.extension() == ".pcd";
    const std::string data = "DATA binary\n";
    const std::size_t begin = radar ? bytes.find(data) : 0;
    const std::size_t stride = radar ? detection_bytes : sweep_bytes;
    if (!file.is_open() || begin == std::string::npos)
        throw world::Error(path.string() + ": was changed; remove it");
    std::vector<Eigen::Vector3f> places;
    for (std::size_t at = begin + (radar ? data.size() : 0); at + stride <= bytes.size();
         at += stride) {
        Eigen::Vector3f place;
        std::memcpy(place.data(), bytes.data() + at, sizeof(place));
        if (place.allFinite())
            places.push_back(place);
    }
    return places;
}

Who who(const nlohmann::ordered_json& one) {
    return one.contains("thing") ? first_thing + one["thing"].get<std::uint32_t>()
                                 : one.at("actor").get<std::uint32_t>();
}

std::string beam_text(const world::SensorFrame& frame,
                      const world::TickView& tick,
                      const world::SensorSpec& placed,
                      std::span<const render::ParkedVehicle> parked) {
    enum Column : std::size_t { x, y, z, cosine, object, tag };

    const Eigen::Isometry3d pose = render::Mount(tick, placed, Eigen::Vector3d::Zero()).pose();
    const PointRows rows(frame);
    std::map<Who, std::size_t> counts;
    for (std::size_t i = 0; i < rows.count(); ++i) {
        if (const std::uint32_t actor = rows.whole(i, object)) {
            ++counts[actor];
        } else if (is_vehicle(rows.whole(i, tag))) {
            const Eigen::Vector3f place(rows.real(i, x), rows.real(i, y), rows.real(i, z));
            if (const auto* vehicle = owner_of(pose * place.cast<double>(), parked))
                ++counts[first_thing + vehicle->thing];
        }
    }
    nlohmann::ordered_json json{{"tick", frame.tick}, {"beams", nlohmann::ordered_json::array()}};
    for (const auto& [met, count] : counts) {
        const bool thing = met >= first_thing;
        json["beams"].push_back(
            {{thing ? "thing" : "actor", thing ? met - first_thing : met}, {"beams", count}});
    }
    return json.dump() + "\n";
}

std::map<Who, std::size_t> read_beams(const std::filesystem::path& path) {
    const auto json = nlohmann::ordered_json::parse(files::json_text(path), nullptr, false);
    std::map<Who, std::size_t> counts;
    try {
        for (const auto& one : json.at("beams"))
            counts[who(one)] = one.at("beams").get<std::size_t>();
    } catch (const nlohmann::json::exception&) {
        throw world::Error(path.string() + ": was changed; remove it");
    }
    return counts;
}

}  // namespace reprise::cli
