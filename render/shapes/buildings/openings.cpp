#include "render/shapes/buildings/openings.h"

#include <algorithm>
#include <cmath>

#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using world::BuildingUse;
using world::FacadeKind;

/// Half width, sill and lintel over the floor.
struct Size {
    float half;
    float low;
    float high;
};

Size window_size(const BuildingPaint& paint, float column, float floor) {
    const float draw = unit(hash(paint.seed, 60));
    switch (paint.model->facade) {
        case FacadeKind::glass:
            return {0.5F * column - 0.03F, 0.06F, floor - 0.40F};
        case FacadeKind::office:
            return {0.5F * column - (draw < 0.5F ? 0.12F : 0.45F), 0.85F, floor - 0.35F};
        case FacadeKind::stone:
            return {std::min(0.60F, 0.27F * column), 0.62F, std::min(floor - 0.5F, 2.75F)};
        case FacadeKind::timber:
            return {std::min(0.48F, 0.26F * column), 0.88F, std::min(floor - 0.4F, 2.15F)};
        case FacadeKind::metal:
            return {0.5F * column - 0.5F, floor - 1.5F, floor - 0.6F};
        default:
            break;
    }
    const bool modern = paint.model->roof == world::RoofKind::flat && draw < 0.6F;
    const float half = modern ? mix(0.75F, 0.95F, draw) : mix(0.50F, 0.62F, draw);
    return {std::min(half, 0.34F * column), modern ? 0.65F : 0.86F, std::min(floor - 0.4F, 2.35F)};
}

bool is_door_column(const Wall& wall, const BuildingPaint& paint, int column) {
    if (wall.use == WallUse::back)
        return column ==
               static_cast<int>(hash(wall.seed, 61) % static_cast<std::uint32_t>(wall.columns));
    if (wall.use != WallUse::front)
        return false;
    return paint.door_every > 0 ? column % paint.door_every == 0 : column == wall.columns / 2;
}

/// The ground floor of a front: shops, gates, doors.
void open_ground(
    Opening& opening, const Wall& wall, const BuildingPaint& paint, int column, float width) {
    const float floor = wall.ground_floor;
    const bool front = wall.use == WallUse::front;
    const bool door = is_door_column(wall, paint, column);
    float half = 0.5F * (opening.right - opening.left);
    const float middle = 0.5F * (opening.left + opening.right);
    if (front && paint.has(world::part_gate)) {
        opening.kind = OpeningKind::gate;
        half = 0.5F * std::min(width - 0.6F, 3.8F);
        opening.low = -1;
        opening.high = std::min(floor - 0.5F, 3.9F);
    } else if (front && paint.has(world::part_shop_front)) {
        opening.kind = door ? OpeningKind::shop_door : OpeningKind::shop;
        half = 0.5F * width - 0.16F;
        opening.low = door ? 0.03F : 0.45F;
        opening.high = floor - 1.02F;
    } else if (door) {
        const bool church = paint.model->roof == world::RoofKind::spire;
        const bool grand = paint.model->use != BuildingUse::house &&
                           paint.model->use != BuildingUse::terrace && front;
        opening.kind = OpeningKind::door;
        half = std::min(0.42F * width, church || grand ? 0.95F : 0.52F);
        opening.low = 0.03F;
        opening.high = church ? 3.3F : std::min(floor - 0.4F, grand ? 2.75F : 2.2F);
    } else if (paint.arched) {
        opening.low = std::min(1.1F, 0.25F * floor);
        opening.high = floor * 0.80F;
        half = std::min(0.75F, 0.22F * width);
    }
    opening.left = middle - half;
    opening.right = middle + half;
}

}  // namespace

bool Opening::contains(float u, float z) const {
    if (kind == OpeningKind::none || u <= left || u >= right || z <= low || z >= high)
        return false;
    const float half = 0.5F * (right - left);
    const float spring = high - half;
    if (!arched || z < spring)
        return true;
    const float across = u - left - half;
    return across * across + (z - spring) * (z - spring) < half * half;
}

float Opening::edge(float u, float z) const {
    const float half = 0.5F * (right - left);
    const float sides = std::min(u - left, right - u);
    if (!arched)
        return std::min(sides, std::min(z - low, high - z));
    const float spring = high - half;
    if (z < spring)
        return std::min(sides, z - low);
    const float across = u - left - half;
    return half - std::sqrt(across * across + (z - spring) * (z - spring));
}

Opening opening_at(const Wall& wall, const BuildingPaint& paint, float u, float z) {
    Opening opening;
    if (z < 0 || wall.use >= WallUse::sign || wall.use == WallUse::blank)
        return opening;
    const float width = wall.length / static_cast<float>(wall.columns);
    const int column = std::min(wall.columns - 1, std::max(0, floor_int(u / width)));
    const bool ground = z < wall.ground_floor;
    const int level = ground ? 0 : 1 + floor_int((z - wall.ground_floor) / wall.floor_height);
    const float base =
        ground ? 0 : wall.ground_floor + wall.floor_height * static_cast<float>(level - 1);
    if (!ground && level > wall.floors)
        return opening;
    const float middle = width * (static_cast<float>(column) + 0.5F);
    opening.seed =
        hash(wall.seed, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(level));
    opening.arched = paint.arched && (ground || paint.model->use == BuildingUse::civic);
    opening.kind = OpeningKind::window;
    const float floor = ground ? wall.ground_floor : wall.floor_height;
    Size size = window_size(paint, width, std::min(floor, ground ? 3.4F : floor));
    if (wall.use == WallUse::window) {
        size.half = 0.5F * wall.length - 0.1F;
        size.low = std::min(size.low, 0.25F * floor);
        size.high = std::min(floor - 0.14F, size.high + 0.1F);
    } else if (wall.use == WallUse::belfry) {
        size = {0.24F * wall.length, 0.5F, wall.height - 0.5F};
        opening.arched = true;
    }
    opening.low = base + size.low;
    opening.high = base + size.high;
    opening.left = middle - size.half;
    opening.right = middle + size.half;
    if (ground)
        open_ground(opening, wall, paint, column, width);
    else if (wall.use == WallUse::front && has_balcony(*paint.model, column, wall.columns)) {
        opening.low = base + 0.06F;
        opening.left = middle - std::max(size.half, std::min(0.9F, 0.36F * width));
        opening.right = 2 * middle - opening.left;
    }
    const bool skipped =
        (wall.use == WallUse::side && hash(opening.seed, 62) % 5 < 2 &&
         paint.model->facade != FacadeKind::glass && paint.model->use != BuildingUse::tower) ||
        (paint.model->facade == FacadeKind::metal && opening.kind == OpeningKind::window &&
         column % 2 == 1);
    if (skipped && opening.kind == OpeningKind::window)
        opening.kind = OpeningKind::none;
    return opening;
}

}  // namespace reprise::render
