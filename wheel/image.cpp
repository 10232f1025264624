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
        Color color{};
        if (sensor.kind == world::SensorKind::semantic) {
            color = color_of(world::SemanticClass{picture.pixels[i]});
        } else {
            float depth = 0;
            std::memcpy(&depth, &picture.pixels[i * sizeof(float)], sizeof(float));
            color.fill(gray_of(depth));
        }
        image.rgb.insert(image.rgb.end(), color.begin(), color.end());
    }
    return image;
}

}  // namespace reprise::wheel
