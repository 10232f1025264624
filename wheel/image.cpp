#include "wheel/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace reprise::wheel {

namespace {

using Color = std::array<std::uint8_t, 3>;
constexpr Color unknown{255, 0, 255};

/// For the eye of who drives; the labels' own colours are the renderer's.
Color color_of(world::SemanticClass what) {
    using enum world::SemanticClass;
    switch (what) {
        case unlabeled:
        case static_object:
        case dynamic_object:
            return {120, 110, 100};
        case road:
            return {72, 74, 78};
        case sidewalk:
            return {156, 152, 146};
        case building:
            return {176, 140, 116};
        case wall:
        case fence:
            return {140, 126, 112};
        case pole:
            return {96, 100, 104};
        case traffic_light:
            return {250, 176, 32};
        case traffic_sign:
            return {226, 226, 60};
        case vegetation:
            return {60, 112, 52};
        case terrain:
            return {116, 152, 84};
        case sky:
            return {150, 190, 228};
        case pedestrian:
        case rider:
            return {220, 40, 70};
        case car:
            return {44, 84, 176};
        case truck:
        case bus:
            return {32, 132, 156};
        case motorcycle:
        case bicycle:
            return {150, 50, 160};
        case bridge:
            return {150, 136, 128};
        case guard_rail:
            return {164, 160, 166};
        case water:
            return {52, 96, 140};
        case road_line:
            return {238, 238, 232};
        case ground:
            return {132, 128, 120};
    }
    return unknown;
}

std::uint8_t gray_of(float depth) {
    constexpr float decades = 3;  // 1 m to 1 km
    const float share = std::log10(std::max(depth, 1.0F)) / decades;
    return static_cast<std::uint8_t>(255 * std::clamp(share, 0.0F, 1.0F));
}

template <typename Value>
Value value_at(const remote::Client::Picture& picture, std::size_t index) {
    Value value{};
    std::memcpy(&value, &picture.pixels[index * sizeof(Value)], sizeof(Value));
    return value;
}

/// Around grey: -1 is black, 1 is white; what is not known is grey as well.
std::uint8_t signed_gray(float share) {
    return static_cast<std::uint8_t>(128 +
                                     127 * std::clamp(share == share ? share : 0, -1.0F, 1.0F));
}

Color color_of(const remote::Client::Picture& picture, std::size_t i) {
    constexpr float full_flow = 32;  // [px]
    switch (picture.sensor->kind) {
        case world::SensorKind::semantic:
            return color_of(world::SemanticClass{picture.pixels[i]});
        case world::SensorKind::instance: {
            // Neighbouring numbers are to look different.
            const std::uint32_t mixed = value_at<std::uint16_t>(picture, i) * 2654435761U;
            return {static_cast<std::uint8_t>(mixed >> 24U),
                    static_cast<std::uint8_t>(mixed >> 16U),
                    static_cast<std::uint8_t>(mixed >> 8U)};
        }
        case world::SensorKind::flow:
            return {signed_gray(value_at<float>(picture, 2 * i) / full_flow),
                    signed_gray(value_at<float>(picture, 2 * i + 1) / full_flow),
                    128};
        case world::SensorKind::normals:
            return {signed_gray(value_at<float>(picture, 3 * i)),
                    signed_gray(value_at<float>(picture, 3 * i + 1)),
                    signed_gray(value_at<float>(picture, 3 * i + 2))};
        case world::SensorKind::dvs:
            return {static_cast<std::uint8_t>(picture.pixels[2 * i] > 0 ? 255 : 0),
                    0,
                    static_cast<std::uint8_t>(picture.pixels[2 * i + 1] > 0 ? 255 : 0)};
        default: {
            const std::uint8_t gray = gray_of(value_at<float>(picture, i));
            return {gray, gray, gray};
        }
    }
}

}  // namespace

Image image_of(const remote::Client::Picture& picture) {
    const world::SensorSpec& sensor = *picture.sensor;
    Image image{sensor.width, sensor.height, {}};
    const std::size_t pixels =
        static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height);
    if (sensor.kind == world::SensorKind::rgb) {
        image.rgb.assign(picture.pixels.begin(), picture.pixels.end());
        return image;
    }
    image.rgb.reserve(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const Color color = color_of(picture, i);
        image.rgb.insert(image.rgb.end(), color.begin(), color.end());
    }
    return image;
}

}  // namespace reprise::wheel
