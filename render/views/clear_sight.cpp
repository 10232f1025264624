#include "render/views/clear_sight.h"

#include <algorithm>
#include <cmath>

#include "ground/mesh/build_ground.h"
#include "ground/obstacles.h"

namespace reprise::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double air = 0.5;         // [m] between a camera and what it must not touch
constexpr double low_enough = 1.2;  // [m] what is lower hides nobody
constexpr double over_ground = 1;   // [m]

/// The part of a way that lies on the inner side of something: shares of it.
struct Inside {
    double from = 0;
    double to = 1;

    /// Keeps what is at most 0 of a quantity that goes evenly from one value to another.
    void cut(double at_start, double at_end) {
        if (at_start <= 0 && at_end <= 0)
            return;
        if (at_start > 0 && at_end > 0) {
            from = 2;
            return;
        }
        const double crossing = at_start / (at_start - at_end);
        if (at_start > 0)
            from = std::max(from, crossing);
        else
            to = std::min(to, crossing);
    }
};

}  // namespace

ClearSight::Block ClearSight::block_of(const world::Obstacle& obstacle) {
    Block block;
    block.low = obstacle.position.z() - obstacle.depth;
    block.high = block.low + 2 * obstacle.half.z();
    const Vector2d middle = obstacle.position.head<2>();
    if (obstacle.shape == world::Obstacle::Shape::prism) {
        for (const Vector3d& corner : obstacle.corners)
            block.outline.emplace_back(middle + corner.head<2>());
    } else {
        const Vector2d ahead = world::ahead_of(obstacle.yaw) * obstacle.half.x();
        const Vector2d left = world::left_of(obstacle.yaw) * obstacle.half.y();
        block.outline = {middle - ahead - left,
                         middle + ahead - left,
                         middle + ahead + left,
                         middle - ahead + left};
    }
    if (world::signed_area(block.outline) < 0)
        std::reverse(block.outline.begin(), block.outline.end());
    return block;
}

ClearSight::ClearSight(const world::TownT& town)
    : ground_(ground::build_ground(town)),
      probe_(ground_) {
    std::vector<world::BoxGrid::Entry> places;
    for (const world::Obstacle& obstacle : ground::obstacles_of(town)) {
        if (obstacle.shape == world::Obstacle::Shape::cylinder ||
            2 * obstacle.half.z() - obstacle.depth < low_enough)
            continue;
        const auto item = static_cast<std::uint32_t>(blocks_.size());
        blocks_.push_back(block_of(obstacle));
        places.push_back({world::box_around(blocks_.back().outline, air), item});
    }
    by_place_ = world::BoxGrid(places);
}

double ClearSight::share(const Vector3d& from, const Vector3d& to) const {
    world::Box way;
    way.take(from.head<2>());
    way.take(to.head<2>());
    double clear = 1;
    for (const std::uint32_t item : by_place_.near(way)) {
        const Block& block = blocks_[item];
        Inside inside;
        inside.cut(block.low - air - from.z(), block.low - air - to.z());
        inside.cut(from.z() - block.high - air, to.z() - block.high - air);
        for (std::size_t i = 0; i < block.outline.size(); ++i) {
            const Vector2d& corner = block.outline[i];
            const Vector2d edge = block.outline[(i + 1) % block.outline.size()] - corner;
            if (!(edge.norm() > 0))
                continue;
            // Distances outwards, to the right of the edge.
            const double start = -world::cross(edge, from.head<2>() - corner) / edge.norm() - air;
            const double end = -world::cross(edge, to.head<2>() - corner) / edge.norm() - air;
            inside.cut(start, end);
        }
        if (inside.from > 0 && inside.from < inside.to)
            clear = std::min(clear, inside.from);
    }
    return clear;
}

Vector3d ClearSight::above_ground(const Vector3d& foot, Vector3d place) const {
    // Metre by metre, so that it is the level of `foot` and not that of a bridge over it, or of the
    // terrain under its road.
    const Vector2d way = (place - foot).head<2>();
    const int metres = static_cast<int>(std::ceil(way.norm()));
    double level = foot.z();
    for (int i = 1; i <= metres; ++i) {
        const Vector2d p = foot.head<2>() + way * (static_cast<double>(i) / metres);
        if (const auto ground = probe_.nearest({p.x(), p.y(), level}))
            level = ground->z;
    }
    place.z() = std::max(place.z(), level + over_ground);
    return place;
}

}  // namespace reprise::render
