#include "world/external/sensor.h"

namespace reprise::world {

std::vector<std::string> sensor_kinds() {
    std::vector<std::string> names;
    for (const SensorKind kind : EnumValuesSensorKind())
        names.emplace_back(EnumNameSensorKind(kind));
    return names;
}

std::optional<SensorKind> find_sensor_kind(std::string_view name) {
    for (const SensorKind kind : EnumValuesSensorKind())
        if (name == EnumNameSensorKind(kind))
            return kind;
    return std::nullopt;
}

std::vector<std::string> camera_kinds() {
    std::vector<std::string> names;
    for (const SensorKind kind : EnumValuesSensorKind())
        if (is_camera(kind))
            names.emplace_back(EnumNameSensorKind(kind));
    return names;
}

std::optional<SensorKind> find_camera_kind(std::string_view name) {
    for (const SensorKind kind : EnumValuesSensorKind())
        if (is_camera(kind) && name == EnumNameSensorKind(kind))
            return kind;
    return std::nullopt;
}

int channels(SensorKind kind) {
    switch (kind) {
        case SensorKind::rgb:
        case SensorKind::normals:
            return 3;
        case SensorKind::flow:
        case SensorKind::dvs:
            return 2;
        default:
            return 1;
    }
}

PixelType pixel_type(SensorKind kind) {
    switch (kind) {
        case SensorKind::depth:
        case SensorKind::flow:
        case SensorKind::normals:
            return PixelType::f32;
        case SensorKind::instance:
            return PixelType::u16;
        default:
            return PixelType::u8;
    }
}

std::size_t bytes_of(PixelType type) {
    return type == PixelType::u8 ? 1 : type == PixelType::u16 ? 2 : 4;
}

}  // namespace reprise::world
