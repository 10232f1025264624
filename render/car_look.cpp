#include "render/look.h"
#include "render/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::BodyStyle;

/// A hit on a car's body, with what is asked about it again and again.
struct Spot {
    const CarShape& shape;
    float x, y, z;
    float side;        ///< |y|
    float half;        ///< half of the car's width
    float height;      ///< of the car
    float belt;        ///< height of the lower edge of the windows here
    float from_front;  ///< [m]
    float from_rear;   ///< [m]
    Vector3f normal;   ///< local
    float fine;        ///< can a line of 2 cm be seen?
    std::uint16_t lamps;
    std::uint64_t tick;
};

const Color black = Color::Constant(0.018F);

Color paint_of(std::uint32_t actor) {
    // By what is sold: white, black and greys first.
    static const std::array<Color, 16> paints{Color(.62F, .62F, .61F),
                                              Color(.58F, .58F, .57F),
                                              Color(.030F, .031F, .034F),
                                              Color(.022F, .023F, .026F),
                                              Color(.13F, .135F, .145F),
                                              Color(.20F, .205F, .21F),
                                              Color(.33F, .335F, .34F),
                                              Color(.40F, .405F, .41F),
                                              Color(.035F, .075F, .22F),
                                              Color(.025F, .045F, .12F),
                                              Color(.42F, .022F, .020F),
                                              Color(.26F, .016F, .022F),
                                              Color(.05F, .13F, .085F),
                                              Color(.36F, .27F, .17F),
                                              Color(.55F, .22F, .03F),
                                              Color(.10F, .24F, .34F)};
    return paints[hash(actor, 11) % paints.size()];
}

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

void as_trim(Look& look, const Color& color = black) {
    look.albedo = color;
    look.gloss = 0;
    look.f0 = 0.04F;
    look.roughness = 0.45F;
}

/// A seam between panels at `edge`, 9 mm wide.
bool seam(const Spot& at, float where, float edge) {
    return at.fine > 0.35F && std::abs(where - edge) < 0.0045F + 0.004F * (1 - at.fine);
}

/// Windows of cars with one cabin. Front and rear doors meet at the middle pillar.
bool is_car_glass(const Spot& at) {
    const float top = at.shape.top(at.x);
    if (top - at.belt < 0.16F || at.z < at.belt + 0.045F)
        return false;
    const bool van = at.shape.style == BodyStyle::van;
    if (at.normal.x() > 0.22F && std::abs(at.normal.y()) < 0.52F)
        return at.z < 0.945F * at.height && at.shape.along(at.x) > 0.5F;
    if (at.normal.x() < -0.22F && std::abs(at.normal.y()) < 0.52F)
        return at.z < 0.93F * at.height && at.z > at.belt + 0.09F && at.side < at.half * 0.72F &&
               (!van || at.side > 0.03F);
    if (std::abs(at.normal.y()) < 0.62F || at.z > std::min(top - 0.10F, 0.915F * at.height))
        return false;
    const float pillar = 0.47F * at.shape.wheelbase();
    if (van)
        return at.x > pillar + 0.35F;
    const float last = at.shape.style == BodyStyle::sedan ? 0.02F : -0.42F;
    const bool quarter = std::abs(at.x - 0.10F) < 0.035F && at.shape.style != BodyStyle::sedan;
    return at.x > last && std::abs(at.x - pillar) > 0.045F && !quarter;
}

bool is_bus_glass(const Spot& at) {
    if (at.normal.x() > 0.5F)
        return at.z > 0.30F * at.height && at.z < 0.90F * at.height && at.side < at.half * 0.93F;
    if (at.normal.x() < -0.5F)
        return at.z > 0.52F * at.height && at.z < 0.82F * at.height && at.side < at.half * 0.8F;
    if (std::abs(at.normal.y()) < 0.6F)
        return false;
    const float front_door = at.from_front;
    const float middle_door = std::abs(at.x - 0.42F * at.shape.wheelbase());
    const bool door =
        at.y < 0 && ((front_door > 0.45F && front_door < 1.7F) || middle_door < 0.65F);
    if (door) {
        const float leaf = std::abs(front_door < 2 ? front_door - 1.07F : middle_door);
        return at.z > 0.16F * at.height && at.z < 0.80F * at.height && leaf > 0.035F;
    }
    return at.z > 0.38F * at.height && at.z < 0.80F * at.height && at.from_rear > 0.9F &&
           fraction(at.from_front / 1.46F) > 0.05F;
}

bool is_cab_glass(const Spot& at) {
    if (at.normal.x() > 0.4F)
        return at.z > 0.535F * at.height && at.z < 0.82F * at.height && at.side < at.half * 0.9F;
    return std::abs(at.normal.y()) > 0.6F && at.z > 0.535F * at.height &&
           at.z < 0.78F * at.height && at.from_front > 0.35F && at.from_front < 1.2F;
}

bool is_glass(const Spot& at) {
    switch (at.shape.style) {
        case BodyStyle::bus:
            return is_bus_glass(at);
        case BodyStyle::lorry:
            return is_cab_glass(at);
        default:
            return is_car_glass(at);
    }
}

bool is_long(const Spot& at) {
    return at.shape.style == BodyStyle::bus || at.shape.style == BodyStyle::lorry;
}

/// Lamps flash twice in three seconds, all cars together: ticks are 50 ms.
bool flashing(const Spot& at) {
    const unsigned bit = at.y > 0 ? world::lamp_left : world::lamp_right;
    return (at.lamps & bit) != 0 && at.tick % 16 < 9;
}

/// `row`: lower edge and height of the lamps.
bool front_lamp(
    Look& look, const Stage& stage, const Spot& at, float low, float high, float inner) {
    if (at.z < low || at.z > high || at.side < inner)
        return false;
    const float light = 1 / stage.sky.exposure();
    const float middle_y = mix(inner, at.half * 0.86F, 0.42F);
    const float dy = (at.side - middle_y) / (at.half - inner);
    const float dz = (at.z - 0.5F * (low + high)) / (high - low);
    const float away = dy * dy * 5 + dz * dz * 4.5F;
    look.f0 = 0.06F;
    look.gloss = 1;
    look.roughness = 0.05F;
    look.albedo = away < 0.5F ? Color(.55F, .56F, .58F) : Color(.16F, .165F, .17F);
    const bool on = (at.lamps & world::lamp_low_beam) != 0 || stage.sky.lamps_on();
    if (on)
        look.emission = Color(1, .95F, .84F) * (light * (away < 0.5F ? 7.0F : 0.30F));
    if (flashing(at) && at.side > mix(inner, at.half, 0.72F))
        look.emission = Color(1.0F, .42F, .03F) * (4 * light);
    return true;
}

bool rear_lamp(Look& look, const Stage& stage, const Spot& at, float low, float high, float inner) {
    if (at.z < low || at.z > high || at.side < inner)
        return false;
    const float light = 1 / stage.sky.exposure();
    const Color red(1.0F, .006F, .004F);
    look.albedo = Color(.26F, .008F, .008F);
    look.f0 = 0.06F;
    look.gloss = 0.6F;
    look.roughness = 0.06F;
    const float row = (at.z - low) / (high - low);
    if ((at.lamps & world::lamp_brake) != 0)
        look.emission = red * (4.5F * light);
    else if (stage.sky.lamps_on() || (at.lamps & world::lamp_low_beam) != 0)
        look.emission = red * (0.8F * light);
    if (flashing(at) && row > 0.62F)
        look.emission = Color(1.0F, .40F, .02F) * (4.5F * light);
    if ((at.lamps & world::lamp_reverse) != 0 && row < 0.25F)
        look.emission = Color(1, .97F, .9F) * (4 * light);
    return true;
}

/// A number plate: white, framed, seven dark signs; unique by the actor.
bool plate(Look& look, const Spot& at, float low, std::uint32_t actor) {
    const float u = at.y + 0.26F;
    const float v = at.z - low;
    if (u < 0 || u > 0.52F || v < 0 || v > 0.115F)
        return false;
    as_trim(look, Color(.62F, .62F, .58F));
    if (u < 0.04F)
        look.albedo = Color(.02F, .05F, .28F);
    else if (u > 0.06F && u < 0.50F && v > 0.025F && v < 0.09F && at.fine > 0.1F) {
        const int sign = floor_int((u - 0.06F) / 0.063F);
        const float inside = fraction((u - 0.06F) / 0.063F);
        const int column = floor_int(inside * 4);
        const int row = floor_int((v - 0.025F) / 0.013F);
        const std::uint32_t dots = hash(actor, static_cast<std::uint32_t>(sign));
        const bool ink = column < 3 && (row == 0 || row == 4 ? column == 1 : true) &&
                         ((dots >> (column * 5 + row)) & 1u) != 0;
        if (ink)
            look.albedo = mix(look.albedo, black, at.fine);
    }
    return true;
}

bool front_details(Look& look, const Stage& stage, const Spot& at, std::uint32_t actor) {
    const float h = at.height;
    if (is_long(at)) {
        if (at.from_front > 0.25F || at.normal.x() < 0.4F)
            return false;
        if (front_lamp(look, stage, at, 0.165F * h, 0.235F * h, 0.62F * at.half))
            return true;
        if (at.shape.style == BodyStyle::bus && at.z > 0.835F * h && at.z < 0.905F * h &&
            at.side < 0.8F) {
            const bool dot = hash(static_cast<std::uint32_t>(floor_int(at.y * 25) + 99),
                                  actor,
                                  static_cast<std::uint32_t>(floor_int(at.z * 25))) %
                                 3 ==
                             0;
            as_trim(look);
            look.emission = Color(1.0F, .45F, .05F) * ((dot ? 1.6F : 0.1F) / stage.sky.exposure());
            return true;
        }
        if (plate(look, at, 0.125F * h, actor))
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
    const float edge = at.belt;
    if (at.from_front < 0.46F &&
        front_lamp(look, stage, at, edge - 0.155F, edge - 0.015F, 0.60F * at.half))
        return true;
    if (at.normal.x() < 0.45F)
        return false;
    if (plate(look, at, 0.225F * h, actor))
        return true;
    const bool grille = at.side < 0.50F * at.half && at.z > 0.325F * h && at.z < 0.415F * h;
    const bool intake = at.side < 0.66F * at.half && at.z > 0.155F * h && at.z < 0.205F * h;
    if (grille || intake) {
        as_trim(look, fraction(at.z / 0.035F) < 0.65F || !grille ? black : Color::Constant(0.10F));
        return true;
    }
    return false;
}

bool rear_details(Look& look, const Stage& stage, const Spot& at, std::uint32_t actor) {
    const float h = at.height;
    if (at.from_rear > 0.34F)
        return false;
    if (at.shape.style == BodyStyle::bus)
        return at.normal.x() < -0.5F &&
               (rear_lamp(look, stage, at, 0.22F * h, 0.33F * h, 0.78F * at.half) ||
                plate(look, at, 0.16F * h, actor));
    const bool van = at.shape.style == BodyStyle::van;
    const float low = van ? 0.36F * h : 0.485F * h;
    const float high = van                                  ? 0.56F * h
                       : at.shape.style == BodyStyle::sedan ? 0.605F * h
                                                            : 0.625F * h;
    if (rear_lamp(look, stage, at, low, high, (van ? 0.82F : 0.56F) * at.half) &&
        (at.normal.x() < -0.15F || at.from_rear < 0.2F))
        return true;
    if (at.normal.x() > -0.45F) {
        as_paint(look, paint_of(actor));
        look.emission = Color::Zero();
        return false;
    }
    if (plate(look, at, (at.shape.style == BodyStyle::sedan || van ? 0.325F : 0.40F) * h, actor))
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
void side_details(Look& look, const Spot& at, const Color& color) {
    if (at.z < at.shape.sill + (is_long(at) ? 0.03F : 0.085F)) {
        as_trim(look);
        return;
    }
    if (is_long(at) || std::abs(at.normal.y()) < 0.5F)
        return;
    const float pillar = 0.47F * at.shape.wheelbase();
    const bool below_windows = at.z < at.belt && at.z > at.shape.sill + 0.12F;
    const float arch = at.shape.wheel_radius() * 1.2F;
    const float last = arch + 0.02F + std::max(0.0F, 0.25F * (0.75F - at.z));
    if (below_windows &&
        (seam(at, at.x, pillar) || seam(at, at.x, at.shape.wheelbase() - arch - 0.10F) ||
         (at.shape.style != BodyStyle::van && seam(at, at.x, last))))
        as_trim(look);
    if (at.x > last && at.x < at.shape.wheelbase() - arch && seam(at, at.z, at.shape.sill + 0.13F))
        as_trim(look);
    const float z = at.z - (at.belt - 0.11F);
    const bool handle =
        std::abs(z) < 0.016F &&
        ((at.x > pillar + .06F && at.x < pillar + .24F) ||
         (at.x > last + .05F && at.x < last + .23F && at.shape.style != BodyStyle::van));
    if (handle)
        look.albedo = color * 0.45F + Color::Constant(0.05F);
}

Look cargo_look(const Stage& stage, const Spot& at, std::uint32_t actor) {
    Look look;
    look.albedo = Color(.58F, .58F, .56F);
    look.roughness = 0.35F;
    const Color brand = paint_of(hash(actor, 3));
    const float low = 0.325F * at.height;
    const float share = (at.z - low) / (at.height - low);
    if (std::abs(at.normal.y()) > 0.5F && share > 0.32F && share < 0.62F)
        look.albedo = brand;
    if (at.normal.x() < -0.5F) {
        if (seam(at, at.y, 0) || at.side > at.half - 0.06F || at.z < low + 0.06F)
            as_trim(look, Color::Constant(0.09F));
        if (rear_lamp(look, stage, at, low - 0.01F, low + 0.16F, 0.76F * at.half))
            return look;
        plate(look, at, low + 0.02F, actor);
    }
    return look;
}

}  // namespace

Look car_look(const Stage& stage, const Surface& surface) {
    const Instance& car = *surface.instance;
    const CarShape& shape = stage.scene.car_shape(car.model);
    const Vector3f& p = surface.local;
    const Spot at{shape,
                  p.x(),
                  p.y(),
                  p.z(),
                  std::abs(p.y()),
                  static_cast<float>(shape.model->width) * 0.5F,
                  shape.height(),
                  shape.belt(p.x()),
                  shape.front - p.x(),
                  p.x() - shape.rear,
                  surface.local_normal,
                  detail(surface, 0.03F),
                  car.lamps,
                  stage.tick};
    Look look;
    const Color color = shape.style == BodyStyle::bus && hash(car.actor) % 2 == 0
                            ? Color(.50F, .03F, .03F)
                            : paint_of(car.actor);
    if (surface.material == Material::car_under) {
        as_trim(look, Color::Constant(0.010F));
    } else if (surface.material == Material::car_cargo) {
        look = cargo_look(stage, at, car.actor);
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
    } else if (is_glass(at)) {
        as_glass(look);
    } else {
        as_paint(look, color);
        if (!front_details(look, stage, at, car.actor) && !rear_details(look, stage, at, car.actor))
            side_details(look, at, color);
    }
    look.normal = surface.normal;
    return look;
}

Look wheel_look(const Surface& at) {
    Look look;
    look.normal = at.normal;
    const Vector3f& p = at.local;
    const float radius = std::sqrt(p.x() * p.x() + p.z() * p.z());
    const bool large = p.y() > 0.115F || at.instance->prototype->mesh.vertices.back().y() < -0.12F;
    const float rim = (large ? 0.48F : 0.325F) * 0.70F;
    if (p.y() < 0 || radius > rim || at.local_normal.y() < 0.2F) {
        as_trim(look, Color::Constant(0.022F));
        look.roughness = 0.8F;
        return look;
    }
    // Five double spokes: angles from the sign of half planes would do, but atan2 is seldom needed
    // here.
    const auto turn = static_cast<float>(
        std::atan2(static_cast<double>(p.z()), static_cast<double>(p.x())) / 6.283185307);
    const float spoke = std::abs(fraction(turn * 5) - 0.5F);
    const float share = radius / rim;
    const bool metal = share > 0.88F || share < 0.24F || spoke < 0.16F + 0.05F * share;
    as_trim(look, metal ? Color(.40F, .41F, .42F) : Color::Constant(0.02F));
    if (metal) {
        look.f0 = 0.4F;
        look.roughness = 0.25F;
    }
    return look;
}

}  // namespace reprise::render
