#include <algorithm>
#include <array>

#include "render/look/wall_surface_point.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::FacadeKind;

/// Glass with what is behind it: a curtain, a dark room, or a lit one at dusk.
void glaze(Look& look,
           const ShadingInput& input,
           const Surface& at,
           const WallSurfacePoint& spot,
           const Opening& opening,
           float u,
           float z) {
    const bool shop = opening.kind == OpeningKind::shop || opening.kind == OpeningKind::shop_door;
    const float share = (u - opening.left) / (opening.right - opening.left);
    const float fate = unit(hash(opening.seed, 2));
    const FacadeKind facade = spot.paint.model->facade;
    const bool tinted = facade == FacadeKind::glass || facade == FacadeKind::office;
    look.f0 = tinted ? 0.12F : 0.06F;
    look.gloss = 1;
    look.roughness = 0.04F;
    // Panes are never quite flat: reflections of long walls bend.
    look.normal = (look.normal + spot.wall.along * (0.012F * (unit(hash(opening.seed, 8)) - 0.5F)) +
                   Vector3f(0, 0, 0.012F * (unit(hash(opening.seed, 9)) - 0.5F)))
                      .normalized();
    // A room: where the view meets its back wall, 2 m behind.
    const float behind = shop ? 2.6F : 2.0F;
    const float room_u = u + spot.slope_u * behind;
    const float room_z = z + spot.slope_z * behind;
    const float back = value_noise(room_u * 0.8F, room_z * 1.1F, opening.seed & 0xffffu);
    Color room = Color(.060F, .055F, .050F) * (0.4F + 1.1F * back);
    if (shop) {
        // Shelves with goods of all colours.
        const int shelf = floor_int(room_z / 0.42F);
        const int item = floor_int(room_u / 0.22F + cell_noise(shelf, 3, 9));
        const float hue = cell_noise(item, shelf, opening.seed & 0xffffu);
        const Color goods(0.09F + 0.20F * hue,
                          0.08F + 0.14F * fraction(hue * 7),
                          0.07F + 0.12F * fraction(hue * 13));
        room = mix(
            room, goods, 0.6F * detail(at, 0.6F) * (fraction(room_z / 0.42F) < 0.7F ? 1.0F : 0.2F));
    }
    const float lit = room_light(input.sky, fate, shop ? 0.75F : tinted ? 0.5F : 0.34F);
    Color lamp = Color::Zero();
    if (lit > 0) {
        const Color warm =
            fate < 0.2F && !tinted ? Color(1.0F, .66F, .34F) : Color(1.0F, .84F, .64F);
        lamp = warm * ((shop ? 0.38F : 0.42F) * (0.45F + 0.9F * back) * lit / input.sky.exposure());
        if (shop)
            lamp *= 0.5F + 2.2F * room;
    }
    const float drawn = unit(hash(opening.seed, 3)) * 0.42F - 0.06F;
    const float blind = unit(hash(opening.seed, 4));
    const bool home = !shop && !tinted && opening.kind == OpeningKind::window;
    if (home && (share < drawn || share > 1 - drawn)) {
        const float fold = 0.7F + 0.3F * value_noise(u * 22, 0.5F, 140);
        room = Color(.36F, .34F, .30F) * fold;
        lamp *= 0.8F * fold;
    } else if (tinted && blind < 0.35F && z > mix(opening.low, opening.high, 1 - 1.6F * blind)) {
        const float slat =
            0.8F + 0.2F * detail(at, 0.06F) * (fraction(z / 0.05F) < 0.5F ? 1.0F : -1.0F);
        room = Color(.30F, .30F, .29F) * slat;
    }
    look.albedo = room * 0.6F;
    look.emission = lamp * 0.8F;
}

void door_leaf(Look& look,
               const Surface& at,
               const WallSurfacePoint& spot,
               const Opening& opening,
               float u,
               float z) {
    const float edge = opening.edge(u, z);
    const float middle = 0.5F * (opening.left + opening.right);
    // Homes of a row have doors of their own.
    const Color own = spot.paint.door_every > 0
                          ? BuildingPaint(*spot.paint.model, opening.seed).door
                          : spot.paint.door;
    const bool wide = opening.right - opening.left > 1.3F;
    const float from_seam = wide ? std::abs(u - middle) : 9.0F;
    const float height = z - opening.low;
    const float panel_u = wide ? std::min(edge, from_seam) : edge;
    const bool panel =
        panel_u > 0.13F && std::abs(height - 0.95F) > 0.07F && std::abs(height - 1.62F) > 0.06F;
    look.albedo = own * (panel ? 0.85F : 1.05F);
    if (edge < 0.06F)
        look.albedo = spot.paint.frame;
    if (from_seam < 0.008F)
        look.albedo *= 0.3F;
    const float knob = std::abs(u - (wide ? middle + 0.09F : opening.right - 0.14F));
    if (knob < 0.025F && std::abs(height - 1.02F) < 0.09F)
        look.albedo = Color(.45F, .40F, .28F);
    look.roughness = 0.35F;
    look.f0 = 0.04F;
    static_cast<void>(at);
}

void gate_leaf(Look& look,
               const ShadingInput& input,
               const Surface& at,
               const WallSurfacePoint& spot,
               const Opening& opening,
               float u,
               float z) {
    const bool fire = spot.paint.model->most_floors > 1;
    const Color color = fire ? Color(.36F, .035F, .03F) : spot.paint.accent * 0.6F + 0.12F;
    const float row = fraction(z / 0.55F);
    const float groove = std::min(row, 1 - row) * 0.55F;
    look.albedo = color * (1 - 0.4F * detail(at, 0.1F) * smooth_step(0.03F, 0.01F, groove));
    look.roughness = 0.4F;
    const int level = floor_int(z / 0.55F);
    const float across = fraction((u - opening.left) / (opening.right - opening.left) * 4);
    const bool pane = level == 3 && row > 0.15F && row < 0.85F && across > 0.1F && across < 0.9F;
    if (pane)
        glaze(look, input, at, spot, opening, u, z);
}

/// Bars between the panes of a window: is this place on one?
bool on_bar(const BuildingPaint& paint, const Opening& opening, float u, float z) {
    const float width = opening.right - opening.left;
    const float height = opening.high - opening.low;
    const float from_middle = std::abs(u - 0.5F * (opening.left + opening.right));
    switch (paint.model->facade) {
        case FacadeKind::glass:
            return false;
        case FacadeKind::office:
        case FacadeKind::metal:
            return fraction((u - opening.left) /
                            (width / std::max(1.0F, std::round(width / 1.2F)))) *
                       1.2F <
                   0.03F;
        default:
            break;
    }
    if (opening.kind == OpeningKind::shop || opening.kind == OpeningKind::shop_door)
        return fraction((u - opening.left) / 1.35F) * 1.35F < 0.045F ||
               std::abs(z - (opening.high - 0.55F)) < 0.03F;
    if (opening.arched && height > 2.5F)
        return from_middle < 0.035F || fraction(z / 0.6F) * 0.6F < 0.035F;
    const std::uint32_t style = hash(paint.seed, 63) % 3;
    if (style == 0)  // a sash: two halves, each of two or more panes
        return std::abs(z - opening.low - 0.5F * height) < 0.03F || (from_middle < 0.014F) ||
               std::abs(z - opening.low - 0.25F * height) < 0.012F ||
               std::abs(z - opening.low - 0.75F * height) < 0.012F;
    if (style == 1)  // two casements under a transom
        return std::abs(z - opening.low - 0.7F * height) < 0.028F || from_middle < 0.03F;
    return from_middle < 0.03F && width > 0.9F;
}

/// Darkens what the reveal keeps the sun from. `depth`: of the pane behind the wall. [m]
float sun_in_reveal(const ShadingInput& input,
                    const WallSurfacePoint& spot,
                    const Opening& opening,
                    float u,
                    float z,
                    float depth) {
    const Vector3f& sun = input.sky.to_sun();
    const float out = -sun.dot(spot.inwards);
    if (out <= 0.02F)
        return 1;
    const float at_wall_u = u + sun.dot(spot.wall.along) / out * depth;
    const float at_wall_z = z + sun.z() / out * depth;
    return opening.contains(at_wall_u, at_wall_z) ? 1.0F : 0.5F;
}

}  // namespace

WallSurfacePoint::WallSurfacePoint(const Wall& of, const BuildingPaint& painted, const Surface& at)
    : wall(of),
      paint(painted),
      inwards(-at.flat) {
    const Eigen::Vector3f away = at.position - wall.foot;
    u = away.dot(wall.along);
    z = away.z();
    const float depth = std::max(0.06F, at.view.dot(inwards));
    slope_u = at.view.dot(wall.along) / depth;
    slope_z = at.view.z() / depth;
}

Look opening_look(const ShadingInput& input,
                  const Surface& at,
                  const WallSurfacePoint& spot,
                  const Opening& opening) {
    const BuildingPaint& paint = spot.paint;
    Look look;
    look.normal = at.normal;
    // Glass and door leaf lie back in the wall; what is seen of the reveal depends on the view.
    const bool glass = paint.model->facade == FacadeKind::glass;
    const float depth = glass ? 0.05F : paint.model->facade == FacadeKind::stone ? 0.26F : 0.17F;
    const float u = spot.u + spot.slope_u * depth;
    const float z = spot.z + spot.slope_z * depth;
    if (!opening.contains(u, z)) {
        const bool sideways = u <= opening.left || u >= opening.right;
        look.albedo = mix(paint.wall, paint.trim, 0.6F) * (sideways           ? 0.85F
                                                           : z <= opening.low ? 1.0F
                                                                              : 0.6F);
        look.normal =
            sideways ? Vector3f(u <= opening.left ? spot.wall.along : Vector3f(-spot.wall.along))
                     : Vector3f(0, 0, z <= opening.low ? 1.0F : -1.0F);
        return look;
    }
    const float edge = opening.edge(u, z);
    if (spot.wall.use == WallUse::belfry) {
        const float slat = fraction(z / 0.24F);
        look.albedo = Color(.12F, .09F, .065F) * (0.35F + 0.9F * slat);
    } else if (opening.kind == OpeningKind::gate) {
        gate_leaf(look, input, at, spot, opening, u, z);
    } else if (opening.kind == OpeningKind::door &&
               (glass || paint.model->facade == FacadeKind::office)) {
        if (edge < 0.08F || std::abs(u - 0.5F * (opening.left + opening.right)) < 0.05F)
            look.albedo = paint.frame;
        else
            glaze(look, input, at, spot, opening, u, z);
    } else if (opening.kind == OpeningKind::door) {
        door_leaf(look, at, spot, opening, u, z);
    } else if (edge < (glass ? 0.03F : 0.06F) || on_bar(paint, opening, u, z)) {
        look.albedo = paint.frame;
        look.roughness = 0.4F;
    } else {
        glaze(look, input, at, spot, opening, u, z);
    }
    const float lit = sun_in_reveal(input, spot, opening, u, z, depth);
    look.albedo *= lit;
    return look;
}

}  // namespace reprise::render
