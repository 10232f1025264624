#include "traffic/props.h"

namespace reprise::traffic {

namespace {

constexpr double sight_height = 1.0;  ///< [m] drivers look over what is lower

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

}  // namespace

bool place_prop(Land& land, const Item& item) {
    const Footprint foot = on_the_ground(item);
    const bool pole = is_pole(item.kind);
    if (!land.roads.is_clear(foot, pole ? pole_margin : kerb_margin) ||
        !land.crossings.is_clear(foot, 0.3) ||
        !land.ways.is_clear(foot, pole ? world::pole_radius : 0) ||
        !land.solid.is_clear(foot, item.from_solid) || land.is_steep(foot.centre))
        return false;
    if (item.from_walk >= 0 && !land.walks.is_clear(foot, item.from_walk))
        return false;
    if (!land.may_stand(foot.centre, 0))
        return false;
    if (!pole && item.height > sight_height && !land.sights.is_clear(foot, sight_distance))
        return false;
    land.solid.add_footprint(foot);
    const Eigen::Vector2d& p = foot.centre;
    land.town.props.emplace_back(world::Vec3(p.x(), p.y(), land.ground(p, item.road_z)),
                                 item.footprint.yaw,
                                 item.footprint.length,
                                 item.footprint.width,
                                 item.height,
                                 item.style,
                                 item.value,
                                 item.kind,
                                 std::uint8_t{0});
    return true;
}

}  // namespace reprise::traffic
