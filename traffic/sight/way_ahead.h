#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "traffic/cars/car.h"
#include "traffic/roads/lane_lines.h"
#include "traffic/roads/road_graph.h"
#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::traffic {

/// A car's body seen from above. [m]
struct BodyBox {
    Eigen::Vector2d middle;
    Eigen::Vector2d ahead;  ///< unit
    double half_length = 0;
    double half_width = 0;

    BodyBox widened(double margin) const {
        return {middle, ahead, half_length + margin, half_width + margin};
    }
};

/// Does one lie in the other? By the axes of both.
bool overlap(const BodyBox& one, const BodyBox& other);

/// [m] that one would have to be moved to lie beside the other; 0 where it does.
double depth(const BodyBox& one, const BodyBox& other);

/// The lane that a car comes to behind this one of its route; none where its route ends.
std::uint32_t lane_after(std::uint32_t lane,
                         const Car& car,
                         const world::TownT& town,
                         const RoadGraph& graph);

/// A box that the car's body does not leave until its bumper is `reach` [m] ahead; somewhat too
/// large, and quicker than its WayAhead. All are read here only.
world::Box area_ahead(const Car& car, const LaneLines& lines, const RoadGraph& graph, double reach);

/// Where a car's body will be when it has driven on so far: its bumper along the lanes of its
/// route, its rear axle where the bumper has been.
class WayAhead {
  public:
    WayAhead() = default;

    WayAhead(const Car& car, const LaneLines& lines, const RoadGraph& graph, double reach) {
        look(car, lines, graph, reach);
    }

    /// Forgets what it knew, but not its memory. `reach` [m] from the bumper that are looked at.
    /// The car must outlive what is asked of this; the others are read here only.
    void look(const Car& car, const LaneLines& lines, const RoadGraph& graph, double reach);

    /// As if it looked again, at a car that has not changed but may lie elsewhere in memory.
    void stay(const Car& car) { car_ = &car; }

    /// When the bumper is `driven` [m] ahead of where it is now; beyond the end of the way, there.
    BodyBox at(double driven) const;

    /// A box along the body of today, at(0).ahead, that no body leaves until the bumper is `driven`
    /// [m] ahead; somewhat too large, and tight beside who drives straight on.
    BodyBox corridor(double driven, const Eigen::Vector2d& ahead) const;

    /// Boxes that the body does not leave while the bumper is between `from` and `to` [m] ahead, in
    /// the order of both; somewhat too large.
    struct Stretch {
        double from = 0;
        double to = 0;
        world::Box area;
    };

    void surround(std::span<Stretch> stretches) const;

    /// [m] that the middle of the body moves at most for each metre driven.
    double most_moved() const;

    /// That the bumper is on, now and until the end of the way; in their order.
    std::span<const std::uint32_t> lanes() const { return lanes_; }

    double length() const { return ends_.back(); }

  private:
    void add(const Eigen::Vector2d& p);
    Eigen::Vector2d bumper_at(double driven) const;
    Eigen::Vector2d between(std::size_t i, double driven) const;

    const Car* car_ = nullptr;
    double to_axle_ = 0;  ///< [m] from the bumper
    double half_length_ = 0, half_width_ = 0, rear_overhang_ = 0;
    std::vector<std::uint32_t> lanes_;
    std::vector<Eigen::Vector2d> points_;  ///< of the bumper, from where it is
    std::vector<double> ends_;             ///< [i] metres to points_[i]
    Eigen::Vector2d rolled_;               ///< [m] of the rear axle beside the bumper's way
};

}  // namespace reprise::traffic
