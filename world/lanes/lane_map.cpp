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

/// Does the centre line come within `reach` of p, in plan? What is farther need not be projected,
/// which costs ten times as much.
bool is_within_reach(const LaneT& lane, const Eigen::Vector2d& p, double reach) {
    const double squared_reach = reach * reach;
    for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i) {
        const Eigen::Vector2d start = in_plan(lane.centre[i]);
        const Eigen::Vector2d along = in_plan(lane.centre[i + 1]) - start;
        const Eigen::Vector2d offset = p - start;
        const double squared_length = along.squaredNorm();
        const double passed = offset.dot(along);
        const double aside = cross(along, offset);
        const bool near = passed <= 0 ? offset.squaredNorm() <= squared_reach
                          : passed >= squared_length
                              ? (offset - along).squaredNorm() <= squared_reach
                              : aside * aside <= squared_reach * squared_length;
        if (near)
            return true;
    }
    return false;
}

constexpr double rounding = 0.01;  ///< [m] more than is lost to it

/// No point of the ribbon, which gives way by `margin` at its sides and its ends, is farther from
/// the centre line.
double ribbon_reach(const LaneT& lane, double margin) {
    return lane.width / 2 + margin + std::max(margin, seam) + rounding;
}

/// A lane whose box is farther away has no surface that gives way by `margin` under a point.
double surface_reach(double margin) {
    return 2 * std::max(margin, seam) + rounding;
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
    std::vector<Box> around;  ///< [lane] all of its surface

    /// Lanes whose box comes within `margin` of p, ascending: few of those in the grid's cells.
    std::vector<std::uint32_t> near(const Eigen::Vector3d& p, double margin) const {
        if (!p.allFinite())
            return {};
        const Box box = box_at(p, margin);
        std::vector<std::uint32_t> found = lanes.near(box);
        std::erase_if(found, [&](std::uint32_t lane) { return !touch(around[lane], box); });
        return found;
    }

    static Box box_at(const Eigen::Vector3d& p, double margin) {
        Box box;
        box.take(p.head<2>(), margin);
        return box;
    }
};

LaneMap::LaneMap(const TownT& town) : town_(&town), grid_(std::make_unique<Grid>()) {
    std::vector<BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (is_for_cars(town.lanes[i]) || is_walkable(town.lanes[i]))
            add_boxes(town.lanes[i], i, entries);
    grid_->lanes = BoxGrid(entries);
    grid_->around.resize(town.lanes.size());
    for (const BoxGrid::Entry& entry : entries)
        grid_->around[entry.item].take(entry.box);
}

LaneMap::~LaneMap() = default;
LaneMap::LaneMap(LaneMap&&) noexcept = default;
LaneMap& LaneMap::operator=(LaneMap&&) noexcept = default;

std::vector<std::uint32_t> LaneMap::near(const Eigen::Vector3d& p_world, double reach) const {
    return grid_->near(p_world, reach + surface_reach(0));
}

std::vector<LaneMap::Found> LaneMap::at(const Eigen::Vector3d& p_world, double margin) const {
    return at(p_world, margin, grid_->near(p_world, surface_reach(margin)));
}

std::vector<LaneMap::Found> LaneMap::at(const Eigen::Vector3d& p_world,
                                        std::span<const std::uint32_t> near) const {
    return at(p_world, 0, near);
}

std::vector<LaneMap::Found> LaneMap::at(const Eigen::Vector3d& p_world,
                                        double margin,
                                        std::span<const std::uint32_t> near) const {
    std::vector<Found> found;
    const Box box = Grid::box_at(p_world, surface_reach(margin));
    for (const std::uint32_t index : near) {
        const LaneT& lane = town_->lanes[index];
        if (!is_for_cars(lane) || !touch(grid_->around[index], box) ||
            !is_within_reach(lane, p_world.head<2>(), ribbon_reach(lane, margin)))
            continue;
        const LaneProjection projection = project(lane, p_world);
        if (is_on_ribbon(lane, projection, p_world, margin))
            found.push_back({index, projection});
    }
    return found;
}

std::vector<LaneMap::Found> LaneMap::walkable_at(const Eigen::Vector3d& p_world) const {
    return walkable_at(p_world, grid_->near(p_world, surface_reach(0)));
}

std::vector<LaneMap::Found> LaneMap::walkable_at(const Eigen::Vector3d& p_world,
                                                 std::span<const std::uint32_t> near) const {
    std::vector<Found> found;
    const Box box = Grid::box_at(p_world, surface_reach(0));
    for (const std::uint32_t index : near) {
        const LaneT& lane = town_->lanes[index];
        if (!is_walkable(lane) || !touch(grid_->around[index], box))
            continue;
        const bool may_hold = lane.outline.empty()
                                  ? is_within_reach(lane, p_world.head<2>(), ribbon_reach(lane, 0))
                                  : is_near_in_height(lane.outline, p_world.z()) &&
                                        contains(in_plan(lane.outline), p_world.head<2>());
        if (!may_hold)
            continue;
        const LaneProjection projection = project(lane, p_world);
        if (!lane.outline.empty() || is_on_ribbon(lane, projection, p_world, 0))
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
        if (!is_for_cars(lane) || !is_within_reach(lane, p_world.head<2>(), reach + rounding))
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
