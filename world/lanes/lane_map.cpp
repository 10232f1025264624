#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/town.h"
#include "world/units.h"

namespace reprise::world {

namespace {

constexpr double seam = 0.001;          ///< [m] where two lanes meet, a point belongs to both
constexpr double metres_per_rad = 4.0;  ///< see LaneMap::best

bool is_walkable(const LaneT& lane) {
    return lane.kind == LaneKind::sidewalk || lane.kind == LaneKind::crossing ||
           lane.kind == LaneKind::walking_area;
}

/// One box for each segment, and one for the outline.
void add_boxes(const LaneT& lane, std::uint32_t index, std::vector<BoxGrid::Entry>& entries) {
    for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i) {
        Box box;
        box.take(in_plan(lane.centre[i]), lane.width / 2);
        box.take(in_plan(lane.centre[i + 1]), lane.width / 2);
        entries.push_back({box, index});
    }
    if (!lane.outline.empty())
        entries.push_back({box_around(in_plan(lane.outline)), index});
}

bool is_near_in_height(const std::vector<Vec3>& outline, double z) {
    return std::any_of(outline.begin(), outline.end(), [&](const Vec3& p) {
        return std::abs(p.z() - z) <= level_clearance;
    });
}

/// Is p on the lane's ribbon? Its ends are cut straight across, and give way by `margin` too.
bool is_on_ribbon(const LaneT& lane,
                  const LaneProjection& at,
                  const Eigen::Vector3d& p,
                  double margin) {
    if (std::abs(at.t) > lane.width / 2 + margin)
        return false;
    const Eigen::Vector3d offset = p - point_at(lane, at.s).position;
    const double squared_overshoot = offset.head<2>().squaredNorm() - at.t * at.t;
    const double reach = std::max(margin, seam);
    return std::abs(offset.z()) <= level_clearance && squared_overshoot <= reach * reach;
}

}  // namespace

struct LaneMap::Grid {
    BoxGrid lanes;

    std::vector<std::uint32_t> near(const Eigen::Vector3d& p, double margin) const {
        if (!p.allFinite())
            return {};
        Box box;
        box.take(p.head<2>(), margin);
        return lanes.near(box);
    }
};

LaneMap::LaneMap(const TownT& town) : town_(&town), grid_(std::make_unique<Grid>()) {
    std::vector<BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (is_for_cars(town.lanes[i]) || is_walkable(town.lanes[i]))
            add_boxes(town.lanes[i], i, entries);
    grid_->lanes = BoxGrid(entries);
}

LaneMap::~LaneMap() = default;
LaneMap::LaneMap(LaneMap&&) noexcept = default;
LaneMap& LaneMap::operator=(LaneMap&&) noexcept = default;

std::vector<LaneMap::Found> LaneMap::at(const Eigen::Vector3d& p_world, double margin) const {
    std::vector<Found> found;
    for (const std::uint32_t index : grid_->near(p_world, std::max(margin, seam))) {
        const LaneT& lane = town_->lanes[index];
        if (!is_for_cars(lane))
            continue;
        const LaneProjection projection = project(lane, p_world);
        if (is_on_ribbon(lane, projection, p_world, margin))
            found.push_back({index, projection});
    }
    return found;
}

std::vector<LaneMap::Found> LaneMap::walkable_at(const Eigen::Vector3d& p_world) const {
    std::vector<Found> found;
    for (const std::uint32_t index : grid_->near(p_world, seam)) {
        const LaneT& lane = town_->lanes[index];
        if (!is_walkable(lane))
            continue;
        const LaneProjection projection = project(lane, p_world);
        const bool holds = lane.outline.empty()
                               ? is_on_ribbon(lane, projection, p_world, 0)
                               : contains(in_plan(lane.outline), p_world.head<2>()) &&
                                     is_near_in_height(lane.outline, p_world.z());
        if (holds)
            found.push_back({index, projection});
    }
    return found;
}

std::optional<LaneMap::Found> LaneMap::best(const Eigen::Vector3d& p_world,
                                            double yaw,
                                            double reach) const {
    std::optional<Found> best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t index : grid_->near(p_world, reach)) {
        const LaneT& lane = town_->lanes[index];
        if (!is_for_cars(lane))
            continue;
        const LaneProjection projection = project(lane, p_world);
        const double turn = std::abs(wrap_angle(point_at(lane, projection.s).yaw - yaw));
        const double cost = projection.distance + metres_per_rad * turn;
        if (projection.distance > reach || turn > std::numbers::pi / 2 || cost >= least)
            continue;
        least = cost;
        best = Found{index, projection};
    }
    return best;
}

}  // namespace reprise::world
