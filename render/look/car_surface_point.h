#pragma once

#include <cmath>

#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

/// A hit on a car's body, with what is asked about it again and again.
struct CarSurfacePoint {
    const CarShape& shape;
    float x, y, z;
    float side;              ///< |y|
    float half;              ///< half of the car's width
    float height;            ///< of the car
    float belt;              ///< height of the lower edge of the windows here
    float from_front;        ///< [m]
    float from_rear;         ///< [m]
    Eigen::Vector3f normal;  ///< local
    float fine;              ///< can a line of 2 cm be seen?
    std::uint16_t lamps;
    std::uint64_t tick;
    std::uint32_t actor;
};

/// `p` and `normal` in the car's frame; lines of 2 cm can be seen, and lamps are off, unless said.
inline CarSurfacePoint car_surface_point(const CarShape& shape,
                                         const Eigen::Vector3f& p,
                                         const Eigen::Vector3f& normal,
                                         float fine = 1,
                                         std::uint16_t lamps = 0,
                                         std::uint64_t tick = 0,
                                         std::uint32_t actor = 0) {
    return {shape,
            p.x(),
            p.y(),
            p.z(),
            std::abs(p.y()),
            static_cast<float>(shape.model->width) * 0.5F,
            shape.height(),
            shape.belt(p.x()),
            shape.front - p.x(),
            p.x() - shape.rear,
            normal,
            fine,
            lamps,
            tick,
            actor};
}

inline bool is_long(const CarSurfacePoint& at) {
    return at.shape.style == world::BodyStyle::bus || at.shape.style == world::BodyStyle::lorry;
}

inline const Color black = Color::Constant(0.018F);

inline void as_trim(Look& look, const Color& color = black) {
    look.albedo = color;
    look.gloss = 0;
    look.f0 = 0.04F;
    look.roughness = 0.45F;
}

bool is_glass(const CarSurfacePoint& at);

/// What is seen through a car's glass: seats, the dashboard, the windows beyond. `view`: unit
/// vector into the car, in its frame; `near`: can a head rest be seen?
void show_cabin(Look& look, const CarSurfacePoint& at, const Eigen::Vector3f& view, float near);

/// x of the pillar behind the front doors.
inline float middle_pillar(const CarSurfacePoint& at) {
    switch (at.shape.style) {
        case world::BodyStyle::coupe:
            return 0.26F * at.shape.wheelbase();
        case world::BodyStyle::minibus:
            return 0.70F * at.shape.wheelbase();
        case world::BodyStyle::pickup:
            return 0.53F * at.shape.wheelbase();
        default:
            return 0.47F * at.shape.wheelbase();
    }
}

// Each paints its thing and says so, when the spot lies on it. `low` and `high` are heights,
// `inner` the distance from the middle where a lamp begins.
bool front_lamp(Look& look,
                const ShadingInput& input,
                const CarSurfacePoint& at,
                float low,
                float high,
                float inner);
bool rear_lamp(Look& look,
               const ShadingInput& input,
               const CarSurfacePoint& at,
               float low,
               float high,
               float inner);
bool number_plate(Look& look, const CarSurfacePoint& at, float low, std::uint32_t actor);

/// Stripes and checks on the sides and ends of a service's vehicle.
void paint_livery(Look& look, const CarSurfacePoint& at);

}  // namespace reprise::render
