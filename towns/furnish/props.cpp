#include "towns/furnish/props.h"

#include <algorithm>
#include <cmath>
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
Footprint on_the_ground(const Item& item) {
    Footprint foot = item.footprint;
    if (is_pole(item.kind))
        foot.length = foot.width;
    return foot;
}

bool goes_in_steps(world::PropKind kind) {
    return kind == world::PropKind::fence || kind == world::PropKind::wall ||
           kind == world::PropKind::hedge;
}

/// One of `count` equal pieces along its length.
Footprint piece_of(const Footprint& whole, int index, int count) {
    const Eigen::Vector2d along(std::cos(whole.yaw), std::sin(whole.yaw));
    Footprint piece = whole;
    piece.length = whole.length / count;
    piece.centre += along * ((index + 0.5) * piece.length - whole.length / 2);
    return piece;
}

bool is_even(const Land& land, const Footprint& foot, double near, double most) {
    const auto ground = land.footing.under(foot, near);
    return ground && ground->rise() <= most;
}

/// Into how many level pieces it is cut to follow the ground; none: that is too steep for it.
std::optional<int> pieces_on(const Land& land, const Item& item, const Footprint& foot) {
    const double near = land.ground(foot.centre, item.road_z);
    const double most = item.kind == world::PropKind::parked_vehicle ? car_slope : even;
    if (is_even(land, foot, near, most))
        return 1;
    if (!goes_in_steps(item.kind))
        return std::nullopt;
    for (int count = 2; foot.length >= count * shortest; ++count) {
        int even_ones = 0;
        while (even_ones < count &&
               is_even(land, piece_of(foot, even_ones, count), near, fence_step))
            ++even_ones;
        if (even_ones == count)
            return count;
    }
    return std::nullopt;
}

/// Where it stands, on the lowest ground under it; a car on the middle of its slope, poles where
/// they are, and lamps as high over the road as elsewhere.
void stand(Land& land, const Item& item, const Footprint& foot, double length) {
    const Eigen::Vector2d& p = foot.centre;
    double z = land.ground(p, item.road_z);
    double height = item.height;
    if (item.kind == world::PropKind::street_light)
        height += std::max(0.0, land.drop(p, item.road_z));
    else if (!is_pole(item.kind) && item.kind != world::PropKind::parked_vehicle)
        if (const auto ground = land.footing.under(foot, z))
            z = ground->low;
    land.town.props.emplace_back(world::Vec3(p.x(), p.y(), z),
                                 item.footprint.yaw,
                                 length,
                                 item.footprint.width,
                                 height,
                                 item.style,
                                 item.value,
                                 item.kind,
                                 std::uint8_t{0});
}

}  // namespace

bool place_prop(Land& land, const Item& item) {
    const Footprint foot = on_the_ground(item);
    const bool pole = is_pole(item.kind);
    if (!land.roads.is_clear(foot, pole ? pole_margin : kerb_margin) ||
        !land.crossings.is_clear(foot, 0.3) ||
        !land.ways.is_clear(foot, pole ? towns::pole_radius : 0) ||
        !land.solid.is_clear(foot, item.from_solid) || land.is_steep(foot.centre))
        return false;
    if (item.from_walk >= 0 && !land.walks.is_clear(foot, item.from_walk))
        return false;
    if (!land.may_stand(foot.centre, 0))
        return false;
    if (!pole && item.height > sight_height && !land.sights.is_clear(foot, sight_distance))
        return false;
    const std::optional<int> pieces = pieces_on(land, item, foot);
    if (!pieces)
        return false;
    land.solid.add_footprint(foot);
    if (*pieces == 1)
        stand(land, item, foot, item.footprint.length);
    else
        for (int i = 0; i < *pieces; ++i) {
            const Footprint piece = piece_of(foot, i, *pieces);
            stand(land, item, piece, piece.length);
        }
    return true;
}

}  // namespace reprise::towns
