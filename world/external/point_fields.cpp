#include "world/external/point_fields.h"

#include <algorithm>

#include "world/external/sensor_attributes.h"

namespace reprise::world {

namespace {

constexpr PointField lidar[] = {
    {"x", false, "[m] ahead"},
    {"y", false, "[m] to the left"},
    {"z", false, "[m] up"},
    {"intensity", false, "share of a white surface's light, [0, 1]"},
    {"time", false, "[s] of the shot before the tick, zero or negative"},
    {"ring", true, "channel, 0 is the uppermost"},
    {"return", true, "0 is the strongest of its shot"},
};
constexpr PointField semantic_lidar[] = {
    {"x", false, "[m] ahead"},
    {"y", false, "[m] to the left"},
    {"z", false, "[m] up"},
    {"cosine", false, "of the angle of incidence"},
    {"object", true, "actor, 0: the town"},
    {"tag", true, "SemanticClass"},
    {"time", false, "[s] of the shot before the tick, zero or negative"},
    {"ring", true, "channel, 0 is the uppermost"},
};
constexpr PointField radar[] = {
    {"velocity", false, "[m/s] along the ray, away from the sensor positive"},
    {"azimuth", false, "[rad] left positive"},
    {"altitude", false, "[rad] up positive"},
    {"depth", false, "[m]"},
    {"snr", false, "[dB] above the receiver's noise"},
    {"rcs", false, "[dBsm] radar cross section"},
};
constexpr PointField obstacle[] = {
    {"other", true, "actor, 0: the town"},
    {"distance", false, "[m]"},
};
constexpr PointField gnss[] = {
    {"latitude", false, "[deg] WGS 84"},
    {"longitude", false, "[deg] WGS 84"},
    {"altitude", false, "[m]"},
};
constexpr PointField imu[] = {
    {"accelerometer_x", false, "[m/s^2] ahead; at rest the axes feel 9.81 upwards"},
    {"accelerometer_y", false, "[m/s^2] to the left"},
    {"accelerometer_z", false, "[m/s^2] up"},
    {"gyroscope_x", false, "[rad/s]"},
    {"gyroscope_y", false, "[rad/s]"},
    {"gyroscope_z", false, "[rad/s] to the left positive"},
    {"compass", false, "[rad] 0 is north, clockwise, in [0, 2 pi)"},
};
constexpr PointField collision[] = {
    {"other", true, "actor, 0: the town"},
    {"impulse", false, "[N s] in this tick; at the end that of the worst tick"},
    {"x", false, "[m] world"},
    {"y", false, "[m] world"},
    {"z", false, "[m] world"},
    {"ended", true, "0: it begins, 1: it is over"},
};
constexpr PointField lane_invasion[] = {
    {"lane", true, "index in the town, whose border it is"},
    {"marking", true, "0 between lanes of one direction, 1 between directions, 2 edge"},
};

}  // namespace

std::span<const PointField> point_fields(SensorKind kind) {
    switch (kind) {
        case SensorKind::lidar:
            return lidar;
        case SensorKind::semantic_lidar:
            return semantic_lidar;
        case SensorKind::radar:
            return radar;
        case SensorKind::obstacle:
            return obstacle;
        case SensorKind::gnss:
            return gnss;
        case SensorKind::imu:
            return imu;
        case SensorKind::collision:
            return collision;
        case SensorKind::lane_invasion:
            return lane_invasion;
        default:
            return {};
    }
}

std::size_t row_bytes(SensorKind kind) {
    return point_fields(kind).size() * (is_reading(kind) ? sizeof(double) : sizeof(float));
}

std::size_t most_rows(const SensorSpec& sensor) {
    const auto said = [&](const char* name) { return attribute(sensor, name); };
    const double time = sensor.step * static_cast<double>(sensor.every);
    switch (sensor.kind) {
        case SensorKind::lidar:
        case SensorKind::semantic_lidar: {
            // A sweep counts whole columns at both of its ends: render/ranging/sweep.h.
            const auto channels = static_cast<std::size_t>(said("channels"));
            const double swept = std::min(time, 1 / said("rotation_frequency"));
            const double columns =
                swept * said("points_per_second") / static_cast<double>(channels) + 2;
            const double returns = sensor.kind == SensorKind::lidar ? said("returns") : 1;
            return static_cast<std::size_t>(columns) * channels * static_cast<std::size_t>(returns);
        }
        case SensorKind::radar:
            return static_cast<std::size_t>(std::max(1.0, said("points_per_second") * time));
        case SensorKind::obstacle:
            return 1;
        default:
            return 0;
    }
}

}  // namespace reprise::world
