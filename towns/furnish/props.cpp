#include "towns/furnish/props.h"

#include <algorithm>
#include <optional>

namespace reprise::towns {

namespace {

constexpr double sight_height = 1.0;  ///< [m] drivers look over what is lower
constexpr double even = 0.24;         ///< [m] of ground under what stands level
constexpr double fence_step = 0.15;   ///< [m] under each piece of a fence that goes down in steps
constexpr double shortest = 0.5;      ///< [m] of such a piece

bool is_pole(world::PropKind kind) {
    return kind == world::PropKind::street_light || kind == world::PropKind::pole ||
           kind == world::PropKind::bollard;
}

/// The foot of a street light is its pole: the rest is above.
Footprint on_the_ground(const PropCandidate& candidate) {
    Footprint foot = candidate.footprint;
    if (is_pole(candidate.kind))
        foot.length = foot.width;
    return foot;
}

bool goes_in_steps(world::PropKind kind) {
    return kind == world::PropKind::fence || kind == world::PropKind::wall ||
           kind == world::PropKind::hedge;
}

/// One of `count` equal pieces along its length.
Footprint piece_of(const Footprint& whole, int index, int count) {
    const Eigen::Vector2d along = world::ahead_of(whole.yaw);
    Footprint piece = whole;
    piece.length = whole.length / count;
    piece.centre += along * ((index + 0.5) * piece.length - whole.length / 2);
    return piece;
}

bool is_even(const PlacementContext& context, const Footprint& foot, double near, double most) {
    const auto ground = context.ground_heights.under(foot, near);
    return ground && ground->rise() <= most;
}

/// Into how many level pieces it is cut to follow the ground; none: that is too steep for it.
std::optional<int> pieces_on(const PlacementContext& context,
                             const PropCandidate& candidate,
                             const Footprint& foot) {
    const double near = context.ground(foot.centre, candidate.road_z);
    const double most = candidate.kind == world::PropKind::parked_vehicle ? car_slope : even;
    if (is_even(context, foot, near, most))
        return 1;
    if (!goes_in_steps(candidate.kind))
        return std::nullopt;
    for (int count = 2; foot.length >= count * shortest; ++count) {
        int even_ones = 0;
        while (even_ones < count &&
               is_even(context, piece_of(foot, even_ones, count), near, fence_step))
            ++even_ones;
        if (even_ones == count)
            return count;
    }
    return std::nullopt;
}

/// Where it stands, on the lowest ground under it; a car on the middle of its slope, poles where
/// they are, and lamps as high over the road as elsewhere.
void stand(PlacementContext& context,
           const PropCandidate& candidate,
           const Footprint& foot,
           double length) {
    const Eigen::Vector2d& p = foot.centre;
    double z = context.ground(p, candidate.road_z);
    double height = candidate.height;
    if (candidate.kind == world::PropKind::street_light)
        height += std::max(0.0, context.drop(p, candidate.road_z));
    else if (!is_pole(candidate.kind) && candidate.kind != world::PropKind::parked_vehicle)
        if (const auto ground = context.ground_heights.under(foot, z))
            z = ground->low;
    context.town.props.emplace_back(world::Vec3(p.x(), p.y(), z),
                                    candidate.footprint.yaw,
                                    length,
                                    candidate.footprint.width,
                                    height,
                                    candidate.style,
                                    candidate.value,
                                    candidate.kind,
                                    std::uint8_t{0});
}

}  // namespace

bool place_prop(PlacementContext& context, const PropCandidate& candidate) {
    const Footprint foot = on_the_ground(candidate);
    const bool pole = is_pole(candidate.kind);
    if (!context.roads.is_clear(foot, pole ? pole_margin : kerb_margin) ||
        !context.crossings.is_clear(foot, 0.3) ||
        !context.walkways.is_clear(foot, pole ? towns::pole_radius : 0) ||
        !context.solid.is_clear(foot, candidate.from_solid) || context.is_steep(foot.centre))
        return false;
    if (candidate.from_walk >= 0 && !context.walks.is_clear(foot, candidate.from_walk))
        return false;
    if (!context.may_stand(foot.centre, 0))
        return false;
    if (!pole && candidate.height > sight_height && !context.sights.is_clear(foot, sight_distance))
        return false;
    const std::optional<int> pieces = pieces_on(context, candidate, foot);
    if (!pieces)
        return false;
    context.solid.add_footprint(foot);
    if (*pieces == 1)
        stand(context, candidate, foot, candidate.footprint.length);
    else
        for (int i = 0; i < *pieces; ++i) {
            const Footprint piece = piece_of(foot, i, *pieces);
            stand(context, candidate, piece, piece.length);
        }
    return true;
}

}  // namespace reprise::towns
