#include <algorithm>
#include <array>
#include <cmath>

#include "render/look/lettering.h"
#include "render/look/wall_surface_point.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using world::FacadeKind;

/// Frames of stone around openings, sills, and shutters. Says whether the place is on one.
bool around_opening(Look& look,
                    const Surface& at,
                    const WallSurfacePoint& spot,
                    const Opening& opening) {
    const BuildingPaint& paint = spot.paint;
    const FacadeKind facade = paint.model->facade;
    if (opening.kind != OpeningKind::window && opening.kind != OpeningKind::door)
        return false;
    if (facade == FacadeKind::glass || facade == FacadeKind::metal ||
        spot.wall.use == WallUse::belfry)
        return false;
    const float out = std::max(opening.left - spot.u, spot.u - opening.right);
    const bool beside = out < 0.10F;
    const float below = opening.low - spot.z;
    const float above = spot.z - opening.high;
    if (opening.kind == OpeningKind::window && below > 0 && below < 0.30F && beside) {
        // A sill that stands out, with its shadow below.
        if (below < 0.09F)
            look.albedo = paint.trim;
        else
            look.albedo *= 1 - 0.45F * smooth_step(0.30F, 0.10F, below);
        return below < 0.09F;
    }
    if (facade == FacadeKind::office)
        return false;
    const bool lintel =
        above > 0 && above < (facade == FacadeKind::stone ? 0.24F : 0.17F) && out < 0.16F;
    const bool jamb = out > 0 && out < 0.12F && below < 0 && above < 0 &&
                      (facade == FacadeKind::stone || facade == FacadeKind::timber ||
                       (facade == FacadeKind::plaster && hash(paint.seed, 64) % 2 == 0));
    if (facade == FacadeKind::brick && lintel && hash(paint.seed, 65) % 2 == 0) {
        // Bricks on end.
        const float joint = fraction(spot.u / 0.075F);
        look.albedo = paint.wall * (joint < 0.15F * detail(at, 0.05F) ? 1.25F : 0.78F);
        return true;
    }
    if (lintel || jamb) {
        look.albedo = paint.trim * (opening.arched ? 0.97F : 1.0F);
        return true;
    }
    if (paint.shutters && opening.kind == OpeningKind::window && below < 0 && above < 0 &&
        out > 0.10F && out < 0.10F + 0.42F * (opening.right - opening.left) &&
        spot.wall.use != WallUse::window) {
        const float slat = fraction(spot.z / 0.075F);
        look.albedo = paint.accent * (0.9F + 0.45F * detail(at, 0.08F) * (slat - 0.5F));
        return true;
    }
    return false;
}

/// Beams of a half-timbered wall: at the floors, beside the windows, and leaning ones.
bool on_beam(const WallSurfacePoint& spot) {
    const Wall& wall = spot.wall;
    const float width = wall.length / static_cast<float>(wall.columns);
    const float u = fraction(spot.u / width) * width;
    const float above = spot.z - wall.ground_floor;
    const float floor = above < 0 ? wall.ground_floor : wall.floor_height;
    const float z =
        above < 0 ? spot.z : above - floor * static_cast<float>(floor_int(above / floor));
    if (z < 0.16F || z > floor - 0.04F || u < 0.09F || u > width - 0.09F)
        return true;
    if (std::abs(z - 0.82F) < 0.06F || std::abs(u - 0.22F * width) < 0.06F ||
        std::abs(u - 0.78F * width) < 0.06F)
        return true;
    const bool east =
        hash(static_cast<std::uint32_t>(floor_int(spot.u / width)), wall.seed) % 2 == 0;
    const float share = (east ? u : width - u) / width;
    return z < 0.82F && std::abs(z / 0.82F - share) < 0.12F;
}

Look sign_look(const ShadingInput& input, const Surface& at, const WallSurfacePoint& spot) {
    const std::uint32_t seed = spot.wall.seed;
    const BuildingPaint own(*spot.paint.model, seed);
    const bool pale = hash(seed, 66) % 3 == 0;
    const Color board = pale ? Color(.55F, .53F, .48F) : own.accent;
    const Color ink = pale ? own.accent * 0.7F : Color(.66F, .63F, .54F);
    const float high = 0.62F * spot.wall.height;
    const float ink_share = shop_name(seed).ink((spot.u - 0.5F * spot.wall.length) / high,
                                                (spot.z - 0.5F * spot.wall.height) / high);
    Look look;
    look.normal = at.normal;
    look.albedo = mix(board, ink, ink_share);
    look.emission = mix(Color(board * 0.3F), ink, ink_share) *
                    (0.7F * input.sky.lamplight() / input.sky.exposure());
    look.roughness = 0.4F;
    return look;
}

Look clock_look(const ShadingInput& input, const Surface& at, const WallSurfacePoint& spot) {
    const float radius = 0.5F * std::min(spot.wall.length, spot.wall.height);
    const float x = (spot.u - 0.5F * spot.wall.length) / radius;
    const float y = (spot.z - 0.5F * spot.wall.height) / radius;
    const float r = std::sqrt(x * x + y * y);
    Look look;
    look.normal = at.normal;
    look.albedo = wall_texture(spot.paint, spot.u, spot.z + 10, at);
    if (r > 0.96F)
        return look;
    // Ten past ten, as in every shop window; marks each hour.
    const auto hand = [&](float sine, float cosine, float length, float half) {
        const float along = x * sine + y * cosine;
        return along > -0.12F && along < length && std::abs(x * cosine - y * sine) < half;
    };
    bool mark = r > 0.88F;
    for (int hour = 0; hour < 12; ++hour) {
        const double angle = hour * 0.52359878;
        const auto sine = static_cast<float>(std::sin(angle));
        const auto cosine = static_cast<float>(std::cos(angle));
        mark |= r > 0.68F && hand(sine, cosine, 0.84F, hour % 3 == 0 ? 0.045F : 0.022F);
    }
    mark |= hand(-0.819F, 0.574F, 0.45F, 0.05F) || hand(0.866F, 0.5F, 0.68F, 0.032F);
    look.albedo = mark ? Color(.03F, .03F, .035F) : Color(.68F, .66F, .60F);
    if (!mark)
        look.emission = Color(1, .9F, .7F) * (0.5F * input.sky.lamplight() / input.sky.exposure());
    return look;
}

Look wall_look(const ShadingInput& input, const Surface& at, const WallSurfacePoint& spot) {
    if (spot.wall.use == WallUse::sign)
        return sign_look(input, at, spot);
    if (spot.wall.use == WallUse::clock)
        return clock_look(input, at, spot);
    const Opening opening = opening_at(spot.wall, spot.paint, spot.u, spot.z);
    if (opening.contains(spot.u, spot.z))
        return opening_look(input, at, spot, opening);
    Look look;
    look.normal = at.normal;
    look.albedo = wall_texture(spot.paint, spot.u + unit(spot.wall.seed) * 90, spot.z, at);
    if (spot.paint.half_timbered && on_beam(spot))
        look.albedo = spot.paint.trim;
    if (around_opening(look, at, spot, opening))
        return look;
    // Panels between the windows of glass and office fronts.
    const FacadeKind facade = spot.paint.model->facade;
    if (facade == FacadeKind::glass && spot.z > 0) {
        look.albedo = spot.paint.wall * 0.6F;
        look.f0 = 0.08F;
        look.gloss = 0.5F;
        look.roughness = 0.1F;
    } else if ((opening.kind == OpeningKind::shop || opening.kind == OpeningKind::shop_door) &&
               spot.z < opening.high + 0.15F) {
        look.albedo = spot.paint.accent * 0.85F;
    }
    return look;
}

}  // namespace

Look model_building_look(const ShadingInput& input, const Surface& at) {
    const Facades& facades = input.scene.facades();
    Look look;
    if (at.material == Material::wall) {
        const Wall& wall = facades.walls[at.tag];
        look = wall_look(input, at, WallSurfacePoint(wall, facades.buildings[wall.building], at));
    } else {
        look = building_part_look(at,
                                  facades.buildings[at.tag / building_finishes],
                                  static_cast<BuildingFinish>(at.tag % building_finishes));
    }
    soak_masonry(look, at.wetness);
    return look;
}

}  // namespace reprise::render
