#include "ground/obstacles.h"

#include <algorithm>
#include <cmath>

#include "ground/mesh/polygons.h"
#include "world/frames.h"
#include "world/models/building_models.h"

namespace reprise::ground {

namespace {

using world::Obstacle;
using world::PropKind;
using Shape = Obstacle::Shape;

constexpr double tall_enough = 3;  ///< [m] what is higher is out of reach
constexpr double head_pole_radius = 0.1;
constexpr double sign_pole_radius = 0.04;
/// [N s] A sign on a thin steel tube (76 mm) breaks off its foot: less than 1 m/s of a small car's
/// speed, as EN 12767 asks of posts that are safe to hit. Masts with cables in them, trunks and
/// walls stand.
constexpr double sign_breaks_at = 600;
constexpr double bush_wood = 0.6;  ///< of its radius; outside of that there are twigs and leaves

Obstacle box(const world::Vec3& foot, double yaw, double length, double width, double height) {
    return {world::to_eigen(foot),
            yaw,
            Eigen::Vector3d(length, width, height) / 2,
            std::hypot(length, width) / 2,
            Shape::box};
}

Obstacle cylinder(const world::Vec3& foot, double radius, double height) {
    const double seen = std::min(height, tall_enough);
    return {world::to_eigen(foot),
            0,
            Eigen::Vector3d(radius, radius, seen / 2),
            radius,
            Shape::cylinder};
}

bool is_bush(world::PlantKind kind) {
    return kind == world::PlantKind::round_bush || kind == world::PlantKind::tall_bush ||
           kind == world::PlantKind::flowering_bush;
}

bool is_sign(PropKind kind) {
    return kind == PropKind::speed_limit_sign || kind == PropKind::stop_sign ||
           kind == PropKind::yield_sign || kind == PropKind::crossing_sign;
}

Obstacle of_prop(const world::Prop& prop) {
    if (is_sign(prop.kind()))
        return cylinder(prop.position(), sign_pole_radius, prop.height());
    switch (prop.kind()) {
        case PropKind::street_light:
            return cylinder(prop.position(), prop.width() / 2, prop.height());
        case PropKind::pole:
        case PropKind::bin:
        case PropKind::bollard:
        case PropKind::hydrant:
        case PropKind::fountain:
            return cylinder(prop.position(), prop.length() / 2, prop.height());
        default:
            return box(prop.position(), prop.yaw(), prop.length(), prop.width(), prop.height());
    }
}

/// On a slope a wall goes on below the floor: nobody drives under a house.
Obstacle with_foundation(Obstacle building) {
    building.depth = world::foundation_depth;
    building.half.z() += building.depth / 2;
    return building;
}

/// A drawn building may be concave: prisms over the convex pieces of its outline.
void add_drawn(const world::DrawnBuildingT& drawn, std::vector<Obstacle>& obstacles) {
    const Eigen::Vector2d origin = world::in_plan(drawn.outline.front());
    Area area(origin);
    area.add(world::in_plan(drawn.outline));
    const double z = drawn.outline.front().z();
    for (const world::Loop& piece : area.pieces()) {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        for (const Eigen::Vector2d& p : piece)
            middle += p / static_cast<double>(piece.size());
        Obstacle prism{Eigen::Vector3d(middle.x(), middle.y(), z),
                       0,
                       Eigen::Vector3d(0, 0, drawn.height / 2),
                       0,
                       Shape::prism};
        for (const Eigen::Vector2d& p : piece) {
            prism.corners.emplace_back(p.x() - middle.x(), p.y() - middle.y(), 0);
            prism.radius = std::max(prism.radius, (p - middle).norm());
        }
        obstacles.push_back(with_foundation(std::move(prism)));
    }
}

}  // namespace

std::vector<Obstacle> obstacles_of(const world::TownT& town) {
    std::vector<Obstacle> obstacles;
    for (const world::Building& b : town.buildings)
        obstacles.push_back(
            with_foundation(box(b.centre(), b.yaw(), b.length(), b.width(), b.height())));
    for (const world::DrawnBuildingT& drawn : town.drawn_buildings)
        add_drawn(drawn, obstacles);
    for (const world::Tree& tree : town.trees)
        obstacles.push_back(cylinder(tree.position(),
                                     is_bush(tree.kind())
                                         ? bush_wood * tree.crown_radius()
                                         : std::clamp(0.025 * tree.height(), 0.1, 0.35),
                                     tree.height()));
    for (std::uint32_t i = 0; i < town.props.size(); ++i) {
        obstacles.push_back(of_prop(town.props[i]));
        if (!is_sign(town.props[i].kind()))
            continue;
        obstacles.back().yaw = town.props[i].yaw();
        obstacles.back().breaks_at = sign_breaks_at;
        obstacles.back().town_prop = i;
    }
    for (std::size_t i = 0; i < town.heads.size(); ++i) {
        // Heads of neighbouring lanes share a pole.
        const world::Vec3& foot = town.heads[i].foot;
        const bool shared = std::any_of(town.heads.begin(),
                                        town.heads.begin() + static_cast<std::ptrdiff_t>(i),
                                        [&](const auto& head) { return head.foot == foot; });
        if (!shared)
            obstacles.push_back(cylinder(foot, head_pole_radius, tall_enough));
    }
    std::stable_sort(obstacles.begin(), obstacles.end(), [](const auto& p, const auto& q) {
        return p.position.x() < q.position.x();
    });
    return obstacles;
}

}  // namespace reprise::ground
