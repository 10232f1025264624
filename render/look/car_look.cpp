#include "render/look/car_surface_point.h"
#include "render/shapes/paint.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::BodyStyle;

void as_paint(Look& look, const Color& color) {
    look.albedo = color;
    look.f0 = 0.045F;
    look.gloss = 1;
    look.roughness = 0.07F;
}

void as_glass(Look& look) {
    look.albedo = Color(.020F, .023F, .024F);
    look.f0 = 0.09F;
    look.gloss = 1;
    look.roughness = 0.03F;
}

bool has_van_doors(const CarSurfacePoint& at) {
    return at.shape.style == BodyStyle::van || at.shape.style == BodyStyle::minibus;
}

/// The number plate sits below a boot lid rather than in a hatch.
bool is_low_tailed(const CarSurfacePoint& at) {
    const BodyStyle style = at.shape.style;
    return style == BodyStyle::sedan || style == BodyStyle::coupe || style == BodyStyle::pickup;
}

/// A seam between panels at `edge`, 9 mm wide.
bool seam(const CarSurfacePoint& at, float where, float edge) {
    return at.fine > 0.35F && std::abs(where - edge) < 0.0045F + 0.004F * (1 - at.fine);
}

bool front_details(Look& look,
                   const ShadingInput& input,
                   const CarSurfacePoint& at,
                   std::uint32_t actor) {
    const float h = at.height;
    if (is_long(at)) {
        if (at.from_front > 0.25F || at.normal.x() < 0.4F)
            return false;
        if (front_lamp(look, input, at, 0.165F * h, 0.235F * h, 0.62F * at.half))
            return true;
        if (at.shape.style == BodyStyle::bus && at.z > 0.835F * h && at.z < 0.905F * h &&
            at.side < 0.8F) {
            const bool dot = hash(static_cast<std::uint32_t>(floor_int(at.y * 25) + 99),
                                  actor,
                                  static_cast<std::uint32_t>(floor_int(at.z * 25))) %
                                 3 ==
                             0;
            as_trim(look);
            look.emission = Color(1.0F, .45F, .05F) * ((dot ? 1.6F : 0.1F) / input.sky.exposure());
            return true;
        }
        if (number_plate(look, at, 0.125F * h, actor))
            return true;
        if (at.shape.style == BodyStyle::lorry && at.z > 0.26F * h && at.z < 0.46F * h &&
            at.side < 0.72F * at.half) {
            as_trim(look, fraction(at.z / 0.09F) < 0.6F ? black : Color::Constant(0.12F));
            return true;
        }
        return false;
    }
    if (at.from_front > 0.55F)
        return false;
    if (at.from_front < 0.42F && at.side > 0.52F * at.half) {
        // As high as the bonnet's edge, level: the belt falls towards the nose.
        const float edge = at.shape.belt(at.shape.front - 0.11F);
        if (front_lamp(look, input, at, edge - 0.175F, edge - 0.015F, 0.54F * at.half))
            return true;
    }
    if (at.normal.x() < 0.45F)
        return false;
    if (number_plate(look, at, 0.225F * h, actor))
        return true;
    const bool grille = at.side < 0.50F * at.half && at.z > 0.325F * h && at.z < 0.415F * h;
    const bool intake = at.side < 0.66F * at.half && at.z > 0.155F * h && at.z < 0.205F * h;
    if (grille || intake) {
        as_trim(look, fraction(at.z / 0.035F) < 0.65F || !grille ? black : Color::Constant(0.10F));
        return true;
    }
    return false;
}

/// Heights and inner edge of a car's rear lamps, as shares of its height and half width.
struct RearLamps {
    float low;
    float high;
    float inner;
};

RearLamps rear_lamps(BodyStyle style) {
    switch (style) {
        case BodyStyle::van:
        case BodyStyle::minibus:
            return {0.30F, 0.50F, 0.84F};
        case BodyStyle::pickup:
            return {0.38F, 0.53F, 0.83F};
        case BodyStyle::sedan:
            return {0.485F, 0.605F, 0.56F};
        case BodyStyle::coupe:
            return {0.555F, 0.635F, 0.42F};
        default:
            return {0.485F, 0.625F, 0.56F};
    }
}

bool rear_details(Look& look,
                  const ShadingInput& input,
                  const CarSurfacePoint& at,
                  std::uint32_t actor,
                  const Color& color) {
    const float h = at.height;
    if (at.from_rear > 0.34F)
        return false;
    if (at.shape.style == BodyStyle::bus)
        return at.normal.x() < -0.5F &&
               (rear_lamp(look, input, at, 0.22F * h, 0.33F * h, 0.78F * at.half) ||
                number_plate(look, at, 0.16F * h, actor));
    const bool van = has_van_doors(at);
    const RearLamps lamps = rear_lamps(at.shape.style);
    if (rear_lamp(look, input, at, lamps.low * h, lamps.high * h, lamps.inner * at.half) &&
        (at.normal.x() < -0.15F || at.from_rear < 0.2F))
        return true;
    if (at.normal.x() > -0.45F) {
        as_paint(look, color);
        look.emission = Color::Zero();
        return false;
    }
    const bool low_plate = van || is_low_tailed(at);
    if (number_plate(look, at, (low_plate ? 0.325F : 0.40F) * h, actor))
        return true;
    if (at.z < 0.245F * h) {
        as_trim(look);
        return true;
    }
    if (seam(at, at.z, 0.36F * h) || (van && seam(at, at.y, 0)))
        as_trim(look);
    return false;
}

/// Doors, handles, sills on the sides.
void side_details(Look& look, const CarSurfacePoint& at, const Color& color) {
    if (at.z < at.shape.sill + (is_long(at) ? 0.03F : 0.085F)) {
        as_trim(look);
        return;
    }
    if (is_long(at) || std::abs(at.normal.y()) < 0.5F)
        return;
    const float pillar = middle_pillar(at);
    const bool rear_door = !has_van_doors(at) && at.shape.style != BodyStyle::coupe;
    const bool below_windows = at.z < at.belt && at.z > at.shape.sill + 0.12F;
    const float arch = at.shape.wheel_radius() * 1.2F;
    const float last = arch + 0.02F + std::max(0.0F, 0.25F * (0.75F - at.z));
    if (below_windows &&
        (seam(at, at.x, pillar) || seam(at, at.x, at.shape.wheelbase() - arch - 0.10F) ||
         (rear_door && seam(at, at.x, last))))
        as_trim(look);
    if (at.x > last && at.x < at.shape.wheelbase() - arch && seam(at, at.z, at.shape.sill + 0.13F))
        as_trim(look);
    const float z = at.z - (at.belt - 0.11F);
    const bool handle =
        std::abs(z) < 0.016F && ((at.x > pillar + .06F && at.x < pillar + .24F) ||
                                 (at.x > last + .05F && at.x < last + .23F && rear_door));
    if (handle)
        look.albedo = color * 0.45F + Color::Constant(0.05F);
}

Look cargo_look(const ShadingInput& input,
                const CarSurfacePoint& at,
                std::uint32_t actor,
                const Color& brand) {
    Look look;
    look.albedo = Color(.58F, .58F, .56F);
    look.roughness = 0.35F;
    const float low = 0.325F * at.height;
    const float share = (at.z - low) / (at.height - low);
    if (std::abs(at.normal.y()) > 0.5F && share > 0.32F && share < 0.62F)
        look.albedo = brand;
    if (at.normal.x() < -0.5F) {
        if (seam(at, at.y, 0) || at.side > at.half - 0.06F || at.z < low + 0.06F)
            as_trim(look, Color::Constant(0.09F));
        if (rear_lamp(look, input, at, low - 0.01F, low + 0.16F, 0.76F * at.half))
            return look;
        number_plate(look, at, low + 0.02F, actor);
    }
    return look;
}

}  // namespace

Look car_look(const ShadingInput& input, const Surface& surface) {
    const Instance& car = *surface.instance;
    const CarShape& shape = input.scene.car_shape(car.model);
    const Vector3f& p = surface.local;
    const CarSurfacePoint at = car_surface_point(
        shape, p, surface.local_normal, detail(surface, 0.03F), car.lamps, input.tick, car.actor);
    Look look;
    const Color& color = car.color;
    if (surface.material == Material::car_under) {
        as_trim(look, Color::Constant(0.010F));
    } else if (surface.material == Material::car_cargo) {
        look = cargo_look(input, at, car.actor, paint_of(*shape.model, car.look).cargo);
    } else if (at.side > shape.half_width(p.x()) + 0.012F) {
        // Mirrors: glass towards the driver.
        if (at.normal.x() < -0.7F)
            as_glass(look);
        else if (is_long(at))
            as_trim(look);
        else
            as_paint(look, color);
    } else if (at.normal.z() < -0.7F) {
        as_trim(look, Color::Constant(0.010F));
    } else if (shape.style == BodyStyle::pickup && at.normal.z() > 0.6F &&
               shape.along(at.x) < 0.37F) {
        as_trim(look);  // the cover over the bed
    } else if (is_glass(at)) {
        as_glass(look);
        show_cabin(look, at, car.normal_to_scene.transpose() * surface.view, detail(surface, 0.2F));
    } else {
        as_paint(look, color);
        if (!front_details(look, input, at, car.actor) &&
            !rear_details(look, input, at, car.actor, color)) {
            paint_livery(look, at);
            side_details(look, at, look.albedo);
        }
    }
    look.normal = surface.normal;
    return look;
}

}  // namespace reprise::render
