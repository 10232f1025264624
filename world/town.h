#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "world/tick.h"
#include "world/town_generated.h"

namespace reprise::world {

/// A place on a lane's centre line.
struct LanePoint {
    Eigen::Vector3d position;  ///< world
    double yaw = 0;            ///< [rad] driving direction, counter-clockwise from east
    double pitch = 0;          ///< [rad] uphill positive
};

/// A point seen from a lane.
struct LaneProjection {
    double s = 0;         ///< [m] along the centre line, in [0, length]
    double t = 0;         ///< [m] left of the centre line
    double distance = 0;  ///< [m] from the nearest centre-line point, in three dimensions
};

/// The centre line at s; s is clamped to [0, length]. O(points).
LanePoint point_at(const LaneT& lane, double s);

/// The point of the centre line nearest to p. O(points).
LaneProjection project(const LaneT& lane, const Eigen::Vector3d& p_world);

/// Index in town.lanes. O(log n).
std::optional<std::uint32_t> find_lane(const TownT& town, std::string_view name);

/// Can cars use it: driving lanes, and the internal lanes that connect them?
inline bool is_for_cars(const LaneT& lane) {
    return lane.kind == LaneKind::driving || lane.kind == LaneKind::internal;
}

/// Does a car find a lane behind it?
inline bool leads_on(const TownT& town, const Link& link) {
    return link.to() < town.lanes.size() && is_for_cars(town.lanes[link.to()]);
}

/// By any of its links?
inline bool leads_on(const TownT& town, const LaneT& lane) {
    return std::any_of(lane.links.begin(), lane.links.end(), [&](const Link& link) {
        return leads_on(town, link);
    });
}

/// Radius of the circle through three neighbouring centre-line points around s. [m]; large when
/// straight.
double curve_radius(const LaneT& lane, double s);

/// Finds lanes by place: a uniform grid over the town, built once. Answers are in ascending index
/// order, so they never depend on how the grid is laid out.
class LaneMap {
  public:
    /// Looks into `town`, which must outlive the map.
    explicit LaneMap(const TownT& town);
    ~LaneMap();
    LaneMap(LaneMap&&) noexcept;
    LaneMap& operator=(LaneMap&&) noexcept;

    struct Found {
        std::uint32_t lane = 0;
        LaneProjection at;
    };

    /// Every lane for cars whose surface (centre line +- half its width + margin) holds p, within
    /// 3 m of height. Ascending by lane.
    std::vector<Found> at(const Eigen::Vector3d& p_world, double margin = 0) const;

    /// As above for sidewalks, crossings and walking areas.
    std::vector<Found> walkable_at(const Eigen::Vector3d& p_world) const;

    /// Lanes of any kind whose bounding box comes within `reach` of p, in plan. Ascending.
    std::vector<std::uint32_t> near(const Eigen::Vector3d& p_world, double reach) const;

    /// `at` and `walkable_at` for one of several points close together: `near` is what `near` found
    /// for all of them.
    std::vector<Found> at(const Eigen::Vector3d& p_world,
                          std::span<const std::uint32_t> near) const;
    std::vector<Found> walkable_at(const Eigen::Vector3d& p_world,
                                   std::span<const std::uint32_t> near) const;

    /// The lane for cars that best fits a vehicle there: within `reach` metres of the centre line
    /// and heading within 90 degrees; least (distance + 4 m per rad of heading difference), ties to
    /// the lower index.
    std::optional<Found> best(const Eigen::Vector3d& p_world, double yaw, double reach = 10) const;

  private:
    struct Grid;

    std::vector<Found> at(const Eigen::Vector3d& p_world,
                          double margin,
                          std::span<const std::uint32_t> near) const;

    const TownT* town_;
    std::unique_ptr<Grid> grid_;
};

}  // namespace reprise::world
