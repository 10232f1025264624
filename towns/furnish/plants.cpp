#include "towns/furnish/plants.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "world/tick.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::PlantKind;
using world::Purpose;

constexpr std::size_t most_plants = 4000;
constexpr double trunk_to_kerb = 0.8;
constexpr double trunk_to_walk = 0.4;
constexpr double trunk_to_solid = 0.8;
constexpr double lorry_height = 4.5;
constexpr double smallest_crown = 0.9;

/// How tall and wide a kind grows. [m]
struct Growth {
    double lowest, highest;
    double slenderest, widest;  ///< crown radius for each metre of height
};

Growth growth(PlantKind kind) {
    switch (kind) {
        case PlantKind::lime:
            return {9, 14, 0.24, 0.30};
        case PlantKind::birch:
            return {8, 13, 0.17, 0.22};
        case PlantKind::poplar:
            return {14, 20, 0.08, 0.11};
        case PlantKind::plane:
            return {10, 15, 0.26, 0.33};
        case PlantKind::maple:
            return {8, 12, 0.25, 0.32};
        case PlantKind::cherry:
            return {4, 6, 0.32, 0.40};
        case PlantKind::pine:
            return {10, 16, 0.17, 0.22};
        case PlantKind::spruce:
            return {8, 17, 0.18, 0.23};
        case PlantKind::round_bush:
            return {0.8, 1.5, 0.45, 0.60};
        case PlantKind::tall_bush:
            return {1.7, 2.8, 0.28, 0.38};
        case PlantKind::flowering_bush:
            return {0.7, 1.3, 0.45, 0.60};
        default:
            return {5, 11, 0.22, 0.32};
    }
}

void add_plant(PlacementContext& context,
               PlantKind kind,
               const Vector2d& foot,
               double road_z,
               double height,
               double crown,
               Draws& draws) {
    context.town.trees.emplace_back(world::Vec3(foot.x(), foot.y(), context.ground(foot, road_z)),
                                    height,
                                    crown,
                                    draws.style(),
                                    kind);
}

/// The largest crown up to `wish` that leaves buildings, and the air over roads, free.
double crown_there(const PlacementContext& context,
                   const Vector2d& foot,
                   double height,
                   double wish) {
    double crown = std::min(wish, context.buildings.of(foot) - 0.3);
    if (height - 2 * crown < lorry_height)
        crown = std::min(crown, std::max(context.roads.of(foot), (height - lorry_height) / 2));
    return crown;
}

constexpr std::array<PlantKind, 3> street_kinds{
    PlantKind::lime, PlantKind::plane, PlantKind::maple};
constexpr std::array<PlantKind, 7> wild_kinds{PlantKind::birch,
                                              PlantKind::maple,
                                              PlantKind::pine,
                                              PlantKind::spruce,
                                              PlantKind::lime,
                                              PlantKind::cherry,
                                              PlantKind::poplar};

/// One kind for a street, at an even distance, behind the sidewalk or on its outer edge where that
/// is wide.
void add_row(PlacementContext& context, const Roadside& roadside, Draws& draws) {
    const bool country = context.is_rural(roadside);
    const bool has_row = draws.chance(country ? 0.7 : 0.65);
    const PlantKind kind = country ? PlantKind::poplar : street_kinds[draws.index(3)];
    const double spacing = country ? draws.between(11, 15) : draws.between(8, 12);
    const double away = roadside.walk > 3.2 ? -0.4
                        : roadside.walk > 0 ? draws.between(0.9, 1.6)
                                            : draws.between(1.6, 2.6);
    if (!has_row)
        return;
    for (double s = draws.between(3, 8); s < roadside.border.length - 3; s += spacing) {
        const RoadsidePose at = roadside_pose(roadside, s, away);
        if (draws.chance(0.93))
            place_tree(context, kind, at.position, at.z, draws, away < 0);
    }
}

/// Groups of one or two kinds behind the first houses.
void add_groups(PlacementContext& context, const Roadside& roadside, double kept, Draws& draws) {
    for (double s = draws.between(0, 20); s < roadside.border.length; s += draws.between(14, 30)) {
        if (!draws.chance(kept))
            continue;
        const double away = draws.between(7, 85);
        const PlantKind kind = wild_kinds[draws.index(wild_kinds.size())];
        const auto count = 1 + draws.index(6);
        for (std::uint32_t i = 0; i < count; ++i) {
            const double off_s = draws.between(-6, 6);
            const double off_away = draws.between(-6, 6);
            const RoadsidePose at = roadside_pose(roadside, s + off_s, away + off_away);
            if (context.roads.is_clear(at.position, 5) && context.reserved.is_clear(at.position, 1))
                place_tree(context, kind, at.position, at.z, draws);
        }
    }
}

/// A wood around the town, so that streets do not end in an empty plain.
void add_belt(PlacementContext& context, const Roadside& roadside, double kept, Draws& draws) {
    constexpr double nearest = 95;
    constexpr double deepest = 130;
    for (double s = draws.between(0, 3); s < roadside.border.length; s += 3) {
        const PlantKind kind = wild_kinds[draws.index(wild_kinds.size())];
        const RoadsidePose at = roadside_pose(roadside, s, draws.between(nearest, deepest));
        if (draws.chance(kept) && context.is_outside(at.position) &&
            context.reserved.is_clear(at.position, 1))
            place_tree(context, kind, at.position, at.z, draws);
    }
}

}  // namespace

bool place_tree(PlacementContext& context,
                PlantKind kind,
                const Vector2d& foot,
                double road_z,
                Draws& draws,
                bool on_walk) {
    const Growth grows = growth(kind);
    const double height = draws.between(grows.lowest, grows.highest);
    const double wish = height * draws.between(grows.slenderest, grows.widest);
    if (context.town.trees.size() >= most_plants || !context.roads.is_clear(foot, trunk_to_kerb) ||
        !context.crossings.is_clear(foot, 1) || !context.may_stand(foot, trunk_to_kerb) ||
        (!on_walk && !context.walks.is_clear(foot, trunk_to_walk)) ||
        !context.solid.is_clear(foot, trunk_to_solid) ||
        !context.sights.is_clear(foot, sight_distance) || context.is_steep(foot) ||
        !context.ground_heights.at(foot, road_z))
        return false;
    const double crown = crown_there(context, foot, height, wish);
    if (crown < std::max(smallest_crown, 0.5 * wish))
        return false;
    add_plant(context, kind, foot, road_z, height, crown, draws);
    context.solid.add_point(foot, 0.3);
    return true;
}

bool place_bush(
    PlacementContext& context, PlantKind kind, const Vector2d& foot, double road_z, Draws& draws) {
    const Growth grows = growth(kind);
    double height = draws.between(grows.lowest, grows.highest);
    const double crown = height * draws.between(grows.slenderest, grows.widest);
    if (!context.sights.is_clear(foot, sight_distance))
        height = std::min(height, 0.9);
    if (context.town.trees.size() >= most_plants || !context.roads.is_clear(foot, crown + 0.5) ||
        !context.walks.is_clear(foot, crown + 0.1) || !context.solid.is_clear(foot, crown * 0.8) ||
        !context.may_stand(foot, 0.5) || context.is_steep(foot) ||
        !context.ground_heights.at(foot, road_z))
        return false;
    add_plant(context, kind, foot, road_z, height, crown, draws);
    context.solid.add_point(foot, crown * 0.6);
    return true;
}

void place_street_trees(PlacementContext& context) {
    double length = 0;
    for (const Roadside& roadside : context.roadsides)
        length += roadside.border.length;
    const double kept = std::min(1.0, most_plants * 5 / std::max(length, 1.0));
    for (std::uint32_t i = 0; i < context.roadsides.size(); ++i) {
        Draws draws(context.seed, Purpose::tree, i);
        if (context.roadsides[i].kerb_side && draws.chance(kept))
            add_row(context, context.roadsides[i], draws);
        add_groups(context, context.roadsides[i], kept, draws);
        add_belt(context, context.roadsides[i], 0.7 * kept, draws);
    }
}

}  // namespace reprise::towns
