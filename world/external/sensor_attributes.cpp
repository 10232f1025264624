#include "world/external/sensor_attributes.h"

#include <algorithm>
#include <cmath>

#include "world/printable.h"

namespace reprise::world {

namespace {

constexpr bool is_flow(SensorKind kind) {
    return kind == SensorKind::flow;
}

constexpr bool is_rgb(SensorKind kind) {
    return kind == SensorKind::rgb;
}

constexpr bool is_dvs(SensorKind kind) {
    return kind == SensorKind::dvs;
}

/// What an exposure is of.
constexpr bool is_exposed(SensorKind kind) {
    return is_rgb(kind) || is_dvs(kind);
}

/// Flow is between two instants, and events are of a tick's whole length.
constexpr bool is_read_out(SensorKind kind) {
    return is_camera(kind) && !is_flow(kind) && !is_dvs(kind);
}

constexpr bool is_lidar(SensorKind kind) {
    return kind == SensorKind::lidar;
}

constexpr bool is_sweeping(SensorKind kind) {
    return kind == SensorKind::lidar || kind == SensorKind::semantic_lidar;
}

constexpr bool is_radar(SensorKind kind) {
    return kind == SensorKind::radar;
}

constexpr bool is_gnss(SensorKind kind) {
    return kind == SensorKind::gnss;
}

constexpr bool is_imu(SensorKind kind) {
    return kind == SensorKind::imu;
}

constexpr bool is_obstacle(SensorKind kind) {
    return kind == SensorKind::obstacle;
}

constexpr bool sees_weather(SensorKind kind) {
    return is_lidar(kind) || is_radar(kind);
}

constexpr bool is_noisy(SensorKind kind) {
    return is_sweeping(kind) || is_radar(kind) || is_gnss(kind) || is_imu(kind) || is_exposed(kind);
}

constexpr double most = 1e9;

// Names, defaults and units of CARLA 0.9.15 where it has them; docs/sensors.md tells which.
constexpr AttributeRow rows[] = {
    {"altitude", is_gnss, 0, -1e4, 1e4, "[m] of z = 0 above the ellipsoid"},
    {"angle_cell", is_radar, 1, 0.05, 30, "[deg] nearer than this is one detection"},
    {"atmosphere_attenuation_rate", is_lidar, 0.004, 0, 1, "[1/m] intensity falls by e^(-a d)"},
    {"beam_divergence", is_lidar, 0.003, 0, 0.05, "[rad] of the whole beam"},
    {"bit_depth", is_rgb, 12, 4, 16, "[bits] of the converter, with noise"},
    {"channels", is_sweeping, 32, 1, 512, "lasers, one above the other"},
    {"cx", is_camera, -1, -1, 1e5, "[px] of the optical axis from the left; -1: the middle"},
    {"cy", is_camera, -1, -1, 1e5, "[px] and from the top"},
    {"distance", is_obstacle, 5, 0.1, 1000, "[m] how far it reaches ahead"},
    {"dropoff_general_rate", is_lidar, 0.45, 0, 1, "share of points that get lost anyhow"},
    {"dropoff_intensity_limit", is_lidar, 0.8, 0, 1, "brighter points do not get lost"},
    {"dropoff_zero_intensity", is_lidar, 0.4, 0, 1, "share of the darkest points that get lost"},
    {"dsnu", is_rgb, 1, 0, 1e4, "[electrons] pixels differ in the dark, with noise"},
    {"exposure_compensation", is_rgb, 0, -20, 20, "[EV] 1: twice as bright"},
    {"exposure_mode",
     is_rgb,
     0,
     0,
     1,
     "by the weather, or by iso, shutter_speed and fstop",
     "automatic,manual"},
    {"focal_distance", is_rgb, 0, 0, 1e4, "[m] that is sharp; 0: everything is"},
    {"forward", is_flow, 0, 0, 1, "1: until the next tick, from a trace only; 0: since the last"},
    {"fstop", is_rgb, 1.4, 0.5, 64, "focal length over the width of the aperture"},
    {"full_well", is_rgb, 10000, 10, 1e7, "[electrons] of the brightest tone at ISO 100"},
    {"fx", is_camera, 0, 0, 1e5, "[px] focal length; 0: by fov_deg"},
    {"fy", is_camera, 0, 0, 1e5, "[px] of rows; 0: as fx"},
    {"gamma", is_rgb, 0, 0, 5, "value = light^(1 / gamma); 0: sRGB"},
    {"hit_radius", is_obstacle, 0.5, 0, 10, "[m] of the tube that it looks along"},
    {"horizontal_fov", is_radar, 30, 1, 180, "[deg]"},
    {"horizontal_fov", is_sweeping, 360, 1, 360, "[deg] swept in a turn"},
    {"iso", is_rgb, 100, 1, 1e6, "speed: exposure of manual, and gain of noise"},
    {"k1",
     is_camera,
     0,
     -10,
     10,
     "distortion as OpenCV has it: Brown and Conrady, of a fisheye Kannala and Brandt"},
    {"k2", is_camera, 0, -10, 10, "likewise"},
    {"k3", is_camera, 0, -10, 10, "likewise"},
    {"k4", is_camera, 0, -10, 10, "likewise, of a fisheye"},
    {"latitude", is_gnss, 42, -85, 85, "[deg] of the origin of a town that lies nowhere"},
    {"lens", is_camera, 0, 0, 1, "how directions become places", "pinhole,fisheye"},
    {"log_eps", is_dvs, 0.001, 1e-6, 1, "added to the light before its logarithm; 1 is white"},
    {"longitude", is_gnss, 2, -180, 180, "[deg] likewise"},
    {"lower_fov", is_sweeping, -30, -90, 90, "[deg] of the lowest laser"},
    {"motion_blur", is_rgb, 0, 0, 1, "1: what moves while the shutter is open is blurred"},
    {"negative_threshold",
     is_dvs,
     0.3,
     0.01,
     10,
     "of the logarithm, for an event of falling light"},
    {"noise", is_rgb, 0, 0, 1, "1: noise after EMVA 1288"},
    {"noise_accel_stddev_x", is_imu, 0, 0, 100, "[m/s^2]"},
    {"noise_accel_stddev_y", is_imu, 0, 0, 100, "[m/s^2]"},
    {"noise_accel_stddev_z", is_imu, 0, 0, 100, "[m/s^2]"},
    {"noise_alt_bias", is_gnss, 0, -1e4, 1e4, "[m]"},
    {"noise_alt_stddev", is_gnss, 0, 0, 1e4, "[m]"},
    {"noise_gyro_bias_x", is_imu, 0, -10, 10, "[rad/s]"},
    {"noise_gyro_bias_y", is_imu, 0, -10, 10, "[rad/s]"},
    {"noise_gyro_bias_z", is_imu, 0, -10, 10, "[rad/s]"},
    {"noise_gyro_stddev_x", is_imu, 0, 0, 10, "[rad/s]"},
    {"noise_gyro_stddev_y", is_imu, 0, 0, 10, "[rad/s]"},
    {"noise_gyro_stddev_z", is_imu, 0, 0, 10, "[rad/s]"},
    {"noise_lat_bias", is_gnss, 0, -10, 10, "[deg]"},
    {"noise_lat_stddev", is_gnss, 0, 0, 10, "[deg]"},
    {"noise_lon_bias", is_gnss, 0, -10, 10, "[deg]"},
    {"noise_lon_stddev", is_gnss, 0, 0, 10, "[deg]"},
    {"noise_seed", is_noisy, 0, 0, most, "another one is another noise"},
    {"noise_stddev", is_lidar, 0, 0, 10, "[m] along the ray, beside range_accuracy"},
    {"only_dynamics", is_obstacle, 0, 0, 1, "1: actors only"},
    {"own_car", is_camera, 0, 0, 1, "1: who carries the camera is in its pictures"},
    {"p1", is_camera, 0, -10, 10, "tangential distortion as OpenCV has it, of a pinhole"},
    {"p2", is_camera, 0, -10, 10, "likewise"},
    {"points_per_second", is_radar, 1500, 1, 1e7, "at most so many detections"},
    {"points_per_second", is_sweeping, 56000, 1, 1e8, "shots of all channels together"},
    {"positive_threshold", is_dvs, 0.3, 0.01, 10, "of the logarithm, for an event of rising light"},
    {"prnu", is_rgb, 0.005, 0, 1, "share by which pixels differ in the light, with noise"},
    {"range", is_radar, 100, 1, 1000, "[m]"},
    {"range", is_sweeping, 10, 0.1, 1000, "[m]"},
    {"range_accuracy", is_lidar, 0.09, 0, 10, "[m] at the limit of what is noticed; 0: exact"},
    {"range_cell", is_radar, 0.3, 0.01, 10, "[m] nearer than this is one detection"},
    {"ray_spacing", is_radar, 0.25, 0.02, 5, "[deg] between the rays that it is made of"},
    {"read_noise", is_rgb, 3, 0, 1e4, "[electrons] with noise"},
    {"readout_time",
     is_read_out,
     0,
     0,
     50,
     "[ms] from the first row to the last, which is of the tick's instant"},
    {"reflectivity", is_lidar, 1, 0, 1, "0: all surfaces are white, as CARLA's"},
    {"refractory_period_ns",
     is_dvs,
     0,
     0,
     1e9,
     "[ns] that a pixel is blind after an event, within a tick"},
    {"returns",
     is_lidar,
     1,
     1,
     3,
     "of a shot at most, the strongest first; 2, 3: five rays a beam"},
    {"rolling", is_sweeping, 1, 0, 1, "0: all points are of the tick's own instant"},
    {"rotation_frequency", is_sweeping, 10, 0.1, 1000, "[Hz]"},
    {"samples", is_dvs, 4, 1, 64, "pictures a tick that events are found between"},
    {"samples", is_rgb, 8, 1, 64, "pictures that blur is the mean of"},
    {"sensitivity_range", is_lidar, 200, 1, 10000, "[m] to see 90 % reflectivity; see docs"},
    {"sensor_width", is_rgb, 7.2, 0.5, 100, "[mm] for the size of the aperture"},
    {"shutter_speed", is_rgb, 200, 20, 1e6, "[1/s] the shutter is open for 1 / shutter_speed"},
    {"speed_cell", is_radar, 0.1, 0.01, 10, "[m/s] likewise"},
    {"tone", is_rgb, 0, 0, 1, "from light to tones", "film,linear"},
    {"upper_fov", is_sweeping, 10, -90, 90, "[deg] of the uppermost laser"},
    {"vertical_fov", is_radar, 30, 1, 180, "[deg]"},
    {"vignette", is_rgb, 0, 0, 1, "share of the light that the corners lack"},
    {"weather", sees_weather, 1, 0, 1, "0: as in clear air on dry ground"},
};

}  // namespace

std::span<const AttributeRow> attribute_rows() {
    return rows;
}

const AttributeRow* find_attribute(SensorKind kind, std::string_view name) {
    for (const AttributeRow& row : rows)
        if (row.name == name && row.is_of(kind))
            return &row;
    return nullptr;
}

std::vector<std::string> attribute_names(SensorKind kind) {
    std::vector<std::string> names;
    for (const AttributeRow& row : rows)
        if (row.is_of(kind))
            names.emplace_back(row.name);
    return names;
}

double attribute(const SensorSpec& sensor, std::string_view name) {
    for (const AttributeValue& said : sensor.attributes)
        if (said.name == name)
            return said.value;
    const AttributeRow* row = find_attribute(sensor.kind, name);
    REPRISE_CHECK(row != nullptr, std::string(name));
    return row->usual;
}

std::vector<std::string> words_of(const AttributeRow& row) {
    std::vector<std::string> words;
    for (std::string_view rest = row.words; !rest.empty();) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        words.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return words;
}

double value_of_word(const AttributeRow& row, const std::string& word) {
    const std::vector<std::string> words = words_of(row);
    const auto found = std::find(words.begin(), words.end(), word);
    if (found != words.end())
        return static_cast<double>(found - words.begin());
    std::string known;
    for (const std::string& one : words)
        known += (known.empty() ? "" : " or ") + one;
    throw WrongWord("'" + std::string(row.name) + "' must be " + known + ", got '" +
                    printable(word) + "'" + did_you_mean(word, words));
}

bool are_possible(SensorKind kind, const std::vector<AttributeValue>& attributes) {
    for (auto one = attributes.begin(); one != attributes.end(); ++one) {
        const AttributeRow* row = find_attribute(kind, one->name);
        const bool again = std::any_of(attributes.begin(), one, [&](const AttributeValue& other) {
            return other.name == one->name;
        });
        if (row == nullptr || again ||
            (!row->words.empty() && one->value != std::floor(one->value)) ||
            !(one->value >= row->low && one->value <= row->high))
            return false;
    }
    return true;
}

}  // namespace reprise::world
