#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::FacadeKind;

/// A place on a wall: u along it, z up from the ground, and how the view goes on behind it.
struct WallPoint {
    float u;
    float z;
    float length;   ///< of the wall
    float slope_u;  ///< metres along the wall for each metre of depth
    float slope_z;
    Vector3f along;    ///< unit vector of growing u, scene
    Vector3f inwards;  ///< scene
    std::uint32_t seed;
};

/// The opening of a window or door, in the wall's coordinates.
struct FacadeOpening {
    float left;
    float right;
    float low;
    float high;
    bool door = false;
    bool shop = false;
    std::uint32_t seed = 0;

    bool contains(float u, float z) const { return u > left && u < right && z > low && z < high; }
};

WallPoint wall_point(const BuildingFrame& building, const Surface& at) {
    const Vector3f away = at.position - building.centre;
    const float x = away.x() * building.cosine + away.y() * building.sine;
    const float y = -away.x() * building.sine + away.y() * building.cosine;
    const float nx = at.flat.x() * building.cosine + at.flat.y() * building.sine;
    const float ny = -at.flat.x() * building.sine + at.flat.y() * building.cosine;
    const bool end = std::abs(nx) > std::abs(ny);
    WallPoint point;
    // u grows to the right for someone who looks at the wall.
    const float side = (end ? nx : -ny) > 0 ? 1.0F : -1.0F;
    point.length = 2 * (end ? building.half.y() : building.half.x());
    point.u = side * (end ? y : x) + 0.5F * point.length;
    point.z = away.z();
    const Vector3f axis_x(building.cosine, building.sine, 0);
    const Vector3f axis_y(-building.sine, building.cosine, 0);
    point.along = end ? Vector3f(side * axis_y) : Vector3f(side * axis_x);
    point.inwards = -at.flat;
    const float depth = std::max(0.05F, at.view.dot(point.inwards));
    point.slope_u = at.view.dot(point.along) / depth;
    point.slope_z = at.view.z() / depth;
    point.seed = hash(building.facade.seed, end ? (nx > 0 ? 1U : 2U) : (ny > 0 ? 3U : 4U));
    return point;
}

FacadeOpening opening_at(const Facade& facade, const WallPoint& point) {
    const int bays = facade.bays(point.length);
    const float bay = point.length / static_cast<float>(bays);
    const int column = std::min(bays - 1, std::max(0, floor_int(point.u / bay)));
    const bool ground = point.z < facade.ground_floor;
    const int floor =
        ground ? -1
               : std::min(facade.floors - 1,
                          floor_int((point.z - facade.ground_floor) / facade.floor_height));
    const float base =
        ground ? 0 : facade.ground_floor + facade.floor_height * static_cast<float>(floor);
    const float middle = bay * (static_cast<float>(column) + 0.5F);
    FacadeOpening opening;
    opening.seed =
        hash(point.seed, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(floor + 1));
    float half = 0.5F * std::min(1.25F, bay * 0.5F);
    opening.low = base + 0.85F;
    opening.high = base + std::min(2.35F, facade.floor_height - 0.35F);
    if (facade.kind == FacadeKind::glass) {
        half = 0.5F * bay - 0.035F;
        opening.low = base + 0.05F;
        opening.high = base + (ground ? facade.ground_floor : facade.floor_height) - 0.42F;
    } else if (facade.kind == FacadeKind::office) {
        half = 0.5F * bay - 0.14F;
        opening.low = base + (ground ? 0.5F : 0.8F);
        opening.high = base + (ground ? facade.ground_floor - 0.75F : facade.floor_height - 0.25F);
    } else if (ground && !facade.gabled) {
        opening.shop = true;
        half = 0.5F * bay - 0.22F;
        opening.low = 0.5F;
        opening.high = 2.95F;
    }
    const int door_column =
        static_cast<int>(hash(point.seed, 9) % static_cast<std::uint32_t>(bays));
    if (ground && column == door_column) {
        opening.door = true;
        opening.shop = false;
        half = std::min(half, 0.55F);
        opening.low = 0.02F;
        opening.high = facade.gabled ? 2.15F : 2.6F;
    }
    opening.left = middle - half;
    opening.right = middle + half;
    if (point.z > facade.ground_floor + facade.floor_height * static_cast<float>(facade.floors) &&
        !ground)
        opening.high = opening.low;  // above the last floor
    return opening;
}

Color wall_color(const Facade& facade) {
    static const std::array<Color, 4> bricks{Color(.30F, .115F, .075F),
                                             Color(.34F, .17F, .10F),
                                             Color(.22F, .10F, .08F),
                                             Color(.40F, .29F, .19F)};
    static const std::array<Color, 7> plasters{Color(.66F, .60F, .48F),
                                               Color(.70F, .68F, .63F),
                                               Color(.60F, .44F, .30F),
                                               Color(.52F, .56F, .55F),
                                               Color(.68F, .55F, .42F),
                                               Color(.55F, .38F, .32F),
                                               Color(.62F, .62F, .52F)};
    static const std::array<Color, 4> stones{Color(.50F, .46F, .39F),
                                             Color(.44F, .43F, .41F),
                                             Color(.56F, .51F, .43F),
                                             Color(.38F, .36F, .34F)};
    static const std::array<Color, 3> panels{
        Color(.42F, .43F, .44F), Color(.55F, .54F, .52F), Color(.28F, .30F, .33F)};
    const std::uint32_t choice = hash(facade.seed, 3);
    switch (facade.kind) {
        case FacadeKind::brick:
            return bricks[choice % 4];
        case FacadeKind::plaster:
            return plasters[choice % 7];
        case FacadeKind::stone:
            return stones[choice % 4];
        case FacadeKind::office:
            return panels[choice % 3];
        default:
            return Color(.16F, .17F, .18F);
    }
}

Color wall_texture(const Facade& facade, const WallPoint& point, const Surface& at) {
    Color color = wall_color(facade);
    float tone =
        0.90F +
        0.2F * fractal_noise(point.u * 0.5F + unit(point.seed) * 90, point.z * 0.35F, 3, 130);
    // Rain has washed dirt down from ledges and up from the pavement.
    tone *=
        1 - 0.16F * smooth_step(1.1F, 0.0F, point.z) * (0.5F + value_noise(point.u * 2, 0.5F, 131));
    if (facade.kind == FacadeKind::brick) {
        const float bricks = detail(at, 0.14F);
        const int course = floor_int(point.z / 0.075F);
        const float shifted = point.u / 0.25F + (course % 2 == 0 ? 0.0F : 0.5F);
        const float fu = fraction(shifted);
        const float fz = fraction(point.z / 0.075F);
        const bool mortar = fu < 0.045F || fz < 0.15F;
        tone *= 1 + bricks * 0.45F * (cell_noise(floor_int(shifted), course, 7) - 0.5F);
        color = mix(color, mortar ? Color(.42F, .39F, .35F) : color, 0.75F * detail(at, 0.03F));
    } else if (facade.kind == FacadeKind::stone) {
        const float joint = std::min(
            fraction(point.z / 0.6F) * 0.6F,
            fraction(point.u / 0.9F + (floor_int(point.z / 0.6F) % 2 == 0 ? 0.0F : 0.5F)) * 0.9F);
        tone *= 1 - 0.35F * detail(at, 0.06F) * smooth_step(0.02F, 0.008F, joint);
    } else {
        tone *=
            1 + 0.08F * detail(at, 0.08F) * (value_noise(point.u * 24, point.z * 24, 132) - 0.5F);
    }
    return color * tone;
}

/// Glass with what is behind it: a curtain, a dark room, or a lit one at dusk.
void glaze_facade(Look& look,
                  const ShadingInput& input,
                  const FacadeOpening& opening,
                  const WallPoint& point,
                  float u,
                  float z) {
    const float width = opening.right - opening.left;
    const float share = (u - opening.left) / width;
    const float fate = unit(hash(opening.seed, 2));
    look.f0 = 0.055F;
    look.gloss = 1;
    look.roughness = 0.04F;
    // A room 3 m deep: where the view meets its floor, ceiling and back wall.
    const float behind = 2.2F;
    const float room_u = u + point.slope_u * behind;
    const float room_z = z + point.slope_z * behind;
    const float back = value_noise(room_u * 0.8F, room_z * 1.1F, opening.seed & 0xffffu);
    Color room = Color(.055F, .050F, .045F) * (0.4F + 1.1F * back);
    const float lit = room_light(input.sky, fate, opening.shop ? 0.7F : 0.34F);
    Color lamp = Color::Zero();
    if (lit > 0) {
        const Color warm = fate < 0.2F ? Color(1.0F, .66F, .34F) : Color(1.0F, .80F, .56F);
        lamp = warm * ((opening.shop ? 0.34F : 0.42F) * (0.45F + 0.9F * back) * lit /
                       input.sky.exposure());
    }
    // Curtains hang at both sides or half drawn.
    const float drawn = unit(hash(opening.seed, 3)) * 0.42F - 0.06F;
    if (!opening.shop && !opening.door && (share < drawn || share > 1 - drawn)) {
        const float fold = 0.7F + 0.3F * value_noise(u * 22, 0.5F, 140);
        room = Color(.34F, .32F, .28F) * fold;
        lamp *= 0.8F * fold;
    }
    look.albedo = room * 0.55F;
    look.emission = lamp * 0.8F;
}

Look facade_wall_look(const ShadingInput& input, const Surface& at, const BuildingFrame& building) {
    const Facade& facade = building.facade;
    const WallPoint point = wall_point(building, at);
    Look look;
    look.normal = at.normal;
    look.albedo = wall_texture(facade, point, at);
    if (point.z < 0 || point.z > facade.eaves)
        return look;
    const FacadeOpening opening = opening_at(facade, point);
    if (!opening.contains(point.u, point.z)) {
        // Lintel and sill are of another stone.
        const bool frame = facade.kind != FacadeKind::glass && !opening.shop &&
                           opening.high > opening.low && point.u > opening.left - .12F &&
                           point.u < opening.right + .12F && point.z > opening.low - .12F &&
                           point.z < opening.high + .16F;
        if (frame)
            look.albedo = mix(look.albedo, Color(.55F, .53F, .49F), 0.65F);
        const bool sign =
            opening.shop && point.z > 3.05F && point.z < 3.65F && facade.kind != FacadeKind::glass;
        if (sign) {
            const std::uint32_t color = hash(point.seed, 30);
            look.albedo = Color(0.08F + 0.4F * unit(color),
                                0.08F + 0.3F * unit(hash(color)),
                                0.1F + 0.3F * unit(hash(color, 2)));
        }
        return look;
    }
    // Glass and door leaf lie back in the wall; what is seen of the reveal depends on the view.
    const float depth = facade.kind == FacadeKind::glass ? 0.06F : 0.20F;
    const float u = point.u + point.slope_u * depth;
    const float z = point.z + point.slope_z * depth;
    if (!opening.contains(u, z)) {
        look.albedo = mix(look.albedo, Color(.5F, .48F, .45F), 0.3F) * 0.75F;
        const bool sideways = u <= opening.left || u >= opening.right;
        look.normal = sideways ? Vector3f(u <= opening.left ? point.along : Vector3f(-point.along))
                               : Vector3f(0, 0, z <= opening.low ? 1.0F : -1.0F);
        return look;
    }
    const float edge = std::min(std::min(u - opening.left, opening.right - u),
                                std::min(z - opening.low, opening.high - z));
    const float cross =
        std::min(std::abs(u - 0.5F * (opening.left + opening.right)),
                 opening.shop ? 9.0F : std::abs(z - mix(opening.low, opening.high, 0.7F)));
    const bool bars = facade.kind == FacadeKind::brick || facade.kind == FacadeKind::plaster;
    const bool frame = edge < 0.055F || (bars && cross < 0.028F);
    if (opening.door && !opening.shop && facade.kind != FacadeKind::glass &&
        facade.kind != FacadeKind::office) {
        static const std::array<Color, 4> doors{Color(.16F, .07F, .035F),
                                                Color(.05F, .11F, .08F),
                                                Color(.06F, .08F, .15F),
                                                Color(.22F, .20F, .18F)};
        const bool panel = edge > 0.14F && cross > 0.05F;
        look.albedo = doors[hash(opening.seed, 4) % 4] * (panel ? 1.0F : 0.75F);
        look.roughness = 0.4F;
    } else if (frame) {
        look.albedo = bars ? Color(.66F, .65F, .62F) : Color(.06F, .065F, .07F);
        look.roughness = 0.4F;
    } else {
        glaze_facade(look, input, opening, point, u, z);
    }
    return look;
}

Look roof_look(const Surface& at, const BuildingFrame& building) {
    Look look;
    look.normal = at.normal;
    const Facade& facade = building.facade;
    const float height = at.position.z() - building.centre.z();
    const bool steep = facade.gabled && height > facade.eaves - 1.2F;
    if (!steep) {
        // Ledges, parapets, balconies and flat roofs.
        const float tone = 0.9F + 0.2F * fractal_noise(at.position.x() * 0.8F,
                                                       at.position.y() * 0.8F + at.position.z(),
                                                       3,
                                                       150);
        look.albedo = at.flat.z() > 0.7F && height > 4
                          ? Color(.21F, .205F, .20F) * tone
                          : mix(wall_color(facade), Color(.50F, .49F, .46F), 0.6F) * tone;
        return look;
    }
    static const std::array<Color, 4> tiles{Color(.33F, .105F, .055F),
                                            Color(.25F, .09F, .06F),
                                            Color(.12F, .12F, .13F),
                                            Color(.28F, .14F, .08F)};
    const Vector3f away = at.position - building.centre;
    const float u = away.x() * building.cosine + away.y() * building.sine;
    const float row = height / 0.21F;
    const float shifted = u / 0.24F + (floor_int(row) % 2 == 0 ? 0.0F : 0.5F);
    const float shade = 1 - 0.5F * detail(at, 0.15F) * smooth_step(0.25F, 0.0F, fraction(row));
    const float tone = (0.85F + 0.3F * fractal_noise(u * 0.7F, height, 2, 151)) *
                       (1 + 0.4F * detail(at, 0.2F) *
                                (cell_noise(floor_int(shifted), floor_int(row), 152) - 0.5F));
    look.albedo = tiles[hash(facade.seed, 8) % 4] * shade * tone;
    return look;
}

}  // namespace

Look building_look(const ShadingInput& input, const Surface& at) {
    const BuildingFrame& building = input.scene.buildings()[at.tag];
    const bool wall = at.material == Material::facade && std::abs(at.flat.z()) < 0.3F;
    Look look = wall ? facade_wall_look(input, at, building) : roof_look(at, building);
    soak_masonry(look, at.wetness);
    return look;
}

}  // namespace reprise::render
