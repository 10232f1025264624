#include "drivers/control/lateral_clearance.h"

#include <algorithm>
#include <cmath>

#include "world/units.h"

namespace reprise::drivers {

namespace {

constexpr double step = 0.2;           // [m] of the search for kerbs
constexpr double aside = 0.35;         // [m] things count this far beside the line
constexpr double lowest_thing = -0.3;  // [m] below the road
constexpr double edge = 0.3;           // [m] beside a lane that are still road
constexpr double queue = 15;           // [m] before the end of a lane that somebody waits on

/// A box or a prism as its outline, a cylinder as a point.
world::Loop outline_of(const world::Obstacle& obstacle) {
    const Eigen::Vector2d middle(obstacle.position.x(), obstacle.position.y());
    if (obstacle.shape == world::Obstacle::Shape::cylinder)
        return {middle};
    world::Loop outline;
    for (const Eigen::Vector3d& corner : obstacle.corners)
        outline.push_back(middle + Eigen::Vector2d(corner.x(), corner.y()));
    if (!outline.empty())
        return outline;
    const Eigen::Vector2d along(std::cos(obstacle.yaw), std::sin(obstacle.yaw));
    const Eigen::Vector2d left(-along.y(), along.x());
    for (const auto& [x, y] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}})
        outline.push_back(middle + x * obstacle.half.x() * along + y * obstacle.half.y() * left);
    return outline;
}

}  // namespace

LateralClearances::LateralClearances(const world::TownT& town,
                                     const world::LaneMap& lanes,
                                     std::span<const world::Obstacle> obstacles)
    : town_(&town),
      lanes_(&lanes) {
    std::vector<world::BoxGrid::Entry> entries;
    for (const world::Obstacle& obstacle : obstacles) {
        const bool round = obstacle.shape == world::Obstacle::Shape::cylinder;
        Thing thing{outline_of(obstacle), round ? obstacle.radius : 0, obstacle.position.z()};
        entries.push_back({world::box_around(thing.outline, thing.radius + aside),
                           static_cast<std::uint32_t>(things_.size())});
        things_.push_back(std::move(thing));
    }
    things_by_place_ = world::BoxGrid(entries);
    entries.clear();
    for (const world::JunctionT& junction : town.junctions) {
        world::Loop outline;
        for (const world::Vec3& p : junction.outline)
            outline.emplace_back(p.x(), p.y());
        if (outline.empty())
            continue;
        entries.push_back(
            {world::box_around(outline, 0), static_cast<std::uint32_t>(junctions_.size())});
        junctions_.push_back(std::move(outline));
    }
    junctions_by_place_ = world::BoxGrid(entries);
}

/// As physics has it: slabs are cut clear of lanes.
bool LateralClearances::is_sidewalk(const Eigen::Vector3d& p_world) const {
    const auto found = lanes_->walkable_at(p_world);
    const bool slab = std::any_of(found.begin(), found.end(), [this](const auto& walkable) {
        return town_->lanes[walkable.lane].kind != world::LaneKind::crossing;
    });
    return slab && lanes_->at(p_world).empty();
}

/// Of a road that leads into a junction, towards us.
bool LateralClearances::is_before_line(const Eigen::Vector3d& p_world,
                                       const Eigen::Vector2d& against) const {
    constexpr double towards_us = -0.7;  // cosine
    const auto found = lanes_->at(p_world);
    return std::any_of(found.begin(), found.end(), [&](const auto& on) {
        const world::LaneT& lane = town_->lanes[on.lane];
        return lane.kind != world::LaneKind::internal && !lane.links.empty() &&
               lane.length - on.at.s < queue &&
               world::ahead_of(world::point_at(lane, on.at.s).yaw).dot(against) < towards_us;
    });
}

double LateralClearances::look_for_line(const Eigen::Vector3d& p_world,
                                        const Eigen::Vector2d& side,
                                        const Eigen::Vector2d& ahead) const {
    const Eigen::Vector3d across(side.x(), side.y(), 0);
    for (double far = step; far < sight; far += step)
        if (is_before_line(p_world + far * across, ahead))
            return far - step / 2;
    return sight;
}

bool LateralClearances::is_on_level(const Thing& thing, double z) {
    const double above = thing.z - z;
    return above >= lowest_thing - world::level_clearance && above <= world::level_clearance;
}

bool LateralClearances::is_clear(const Eigen::Vector3d& from_world,
                                 const Eigen::Vector3d& to_world,
                                 double reach) const {
    const Eigen::Vector2d from = from_world.head<2>();
    const Eigen::Vector2d to = to_world.head<2>();
    world::Box box;
    box.take(from, reach);
    box.take(to, reach);
    const auto near = things_by_place_.near(box);
    return std::none_of(near.begin(), near.end(), [&](std::uint32_t index) {
        const Thing& thing = things_[index];
        return is_on_level(thing, from_world.z()) &&
               world::distance_to(thing.outline, from, to) < thing.radius + reach;
    });
}

/// Between the lanes of a junction there is road, too; whether it lies above or below is not asked.
bool LateralClearances::is_road(const Eigen::Vector3d& p_world) const {
    if (!lanes_->at(p_world, edge).empty())
        return true;
    const Eigen::Vector2d p = p_world.head<2>();
    const auto near = junctions_by_place_.at(p);
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t index) {
        return world::contains(junctions_[index], p);
    });
}

LateralClearance LateralClearances::look(const Eigen::Vector3d& p_world,
                                         const Eigen::Vector2d& side) const {
    const Eigen::Vector3d across(side.x(), side.y(), 0);
    LateralClearance clearance{sight, sight, sight, sight};
    bool on_road = is_road(p_world);  // who is led over a meadow has no verge
    for (double far = step; far < sight; far += step) {
        const Eigen::Vector3d place = p_world + far * across;
        if (is_sidewalk(place)) {
            clearance.to_kerb = far - step / 2;
            break;
        }
        if (on_road && !is_road(place)) {
            clearance.to_verge = far - step / 2;
            on_road = false;
        }
    }
    const Eigen::Vector2d from = p_world.head<2>();
    world::Box box;
    box.take(from, aside);
    box.take(from + sight * side, aside);
    for (const std::uint32_t index : things_by_place_.near(box)) {
        const Thing& thing = things_[index];
        if (!is_on_level(thing, p_world.z()))
            continue;
        // Halve: how far can one go?
        double free = 0;
        double met = clearance.to_obstacle;
        const auto touches = [&](double far) {
            return world::distance_to(thing.outline, from, from + far * side) <
                   thing.radius + aside;
        };
        if (!touches(met))
            continue;
        while (met - free > 0.02) {
            const double middle = (free + met) / 2;
            (touches(middle) ? met : free) = middle;
        }
        clearance.to_obstacle = free;
    }
    return clearance;
}

}  // namespace reprise::drivers
