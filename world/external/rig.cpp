#include "world/external/rig.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "world/check.h"
#include "world/external/point_fields.h"
#include "world/external/sensor_attributes.h"
#include "world/frames.h"

namespace reprise::world {

namespace {

/// A little wider than what scripts are held to: degrees have become radians.
bool is_possible(const SensorSpec& sensor, std::uint32_t every) {
    const auto within = [](double value, double low, double high) {
        return value >= low && value <= high;
    };
    constexpr double turn = 2 * std::numbers::pi + 1e-9;
    const double degree = std::numbers::pi / 180;
    return is_sensor_name(sensor.name) &&
           (is_camera(sensor.kind) || is_ranging(sensor.kind) || is_reading(sensor.kind)) &&
           within(sensor.width, 1, largest_picture_side) &&
           within(sensor.height, 1, largest_picture_side) &&
           within(sensor.fov,
                  narrowest_view_deg * degree - 1e-9,
                  widest_fisheye_deg * degree + 1e-9) &&
           sensor.position.allFinite() &&
           sensor.position.lpNorm<Eigen::Infinity>() <= farthest_mount &&
           within(sensor.yaw, -turn, turn) && within(sensor.pitch, -turn, turn) &&
           within(sensor.roll, -turn, turn) && are_possible(sensor.kind, sensor.attributes) &&
           contradiction(sensor).empty() && every >= 1 && every <= longest_sensor_period;
}

}  // namespace

std::vector<std::size_t> Rig::due(std::uint64_t tick) const {
    std::vector<std::size_t> found;
    for (std::size_t sensor = 0; sensor < sensors.size(); ++sensor)
        if (is_due(sensor, tick))
            found.push_back(sensor);
    return found;
}

Rig rig_of(const CommandT& spawn, std::uint64_t tick, double step) {
    Rig rig;
    rig.since = tick;
    if (spawn.rig.size() > most_sensors)
        throw Error(fmt::format("actor {} carries {} sensors, where {} is the most",
                                spawn.actor,
                                spawn.rig.size(),
                                most_sensors));
    for (const auto& said : spawn.rig) {
        SensorSpec sensor;
        sensor.name = said->name;
        sensor.kind = said->kind;
        sensor.width = said->width;
        sensor.height = said->height;
        sensor.fov = said->fov;
        sensor.actor = spawn.actor;
        sensor.position = to_eigen(said->position);
        sensor.yaw = said->yaw;
        sensor.pitch = said->pitch;
        sensor.roll = said->roll;
        for (const auto& one : said->attributes)
            sensor.attributes.push_back({one->name, one->value});
        const bool taken =
            std::any_of(rig.sensors.begin(), rig.sensors.end(), [&](const SensorSpec& other) {
                return other.name == sensor.name;
            });
        if (taken || !is_possible(sensor, said->every))
            throw Error(fmt::format("actor {} carries a sensor {} that is not possible",
                                    spawn.actor,
                                    rig.sensors.size() + 1));
        sensor.step = step;
        sensor.every = said->every;
        rig.sensors.push_back(sensor);
        rig.every.push_back(said->every);
    }
    return rig;
}

Rig rig_of(const Command& spawn, std::uint64_t tick, double step) {
    CommandT command;
    spawn.UnPackTo(&command);
    return rig_of(command, tick, step);
}

std::string contradiction(const SensorSpec& sensor) {
    if (find_attribute(sensor.kind, "upper_fov") != nullptr &&
        attribute(sensor, "upper_fov") < attribute(sensor, "lower_fov"))
        return "upper_fov is below lower_fov, and ring 0 is the uppermost";
    if (!is_camera(sensor.kind))
        return "";
    const bool fisheye = attribute(sensor, "lens") > 0;
    const auto said = [&](const char* name) { return attribute(sensor, name) != 0; };
    if (fisheye && (said("p1") || said("p2")))
        return "a fisheye has k1, k2, k3 and k4, and no p1 and p2";
    if (!fisheye && said("k4"))
        return "k4 is of lens fisheye; a pinhole has k1, k2, p1, p2 and k3";
    if (!fisheye && sensor.fov > widest_view_deg * std::numbers::pi / 180 + 1e-9)
        return "a field of view beyond 170 degrees needs lens fisheye";
    return "";
}

bool takes_time(const SensorSpec& sensor) {
    const auto said = [&](std::string_view name) {
        return find_attribute(sensor.kind, name) != nullptr && attribute(sensor, name) > 0;
    };
    return sensor.kind == SensorKind::dvs || said("readout_time") || said("motion_blur");
}

bool see_motion(const SensorRig& sensors) {
    return std::any_of(sensors.begin(), sensors.end(), [](const SensorSpec& sensor) {
        return sensor.kind == SensorKind::flow || takes_time(sensor);
    });
}

bool need_last(const SensorRig& sensors) {
    return see_motion(sensors) ||
           std::any_of(sensors.begin(), sensors.end(), [](const SensorSpec& sensor) {
               return sensor.kind == SensorKind::imu || sensor.kind == SensorKind::lane_invasion;
           });
}

bool is_sensor_name(std::string_view name) {
    return !name.empty() && name.size() <= longest_sensor_name &&
           std::all_of(name.begin(), name.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '-';
           });
}

std::size_t picture_bytes(const SensorSpec& sensor) {
    const std::size_t pixel =
        bytes_of(pixel_type(sensor.kind)) * static_cast<std::size_t>(channels(sensor.kind));
    return static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height) * pixel;
}

std::size_t frame_bytes(const SensorSpec& sensor) {
    return is_camera(sensor.kind) ? picture_bytes(sensor)
                                  : most_rows(sensor) * row_bytes(sensor.kind);
}

}  // namespace reprise::world
