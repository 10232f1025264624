#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "drivers/bodies.h"
#include "drivers/control/ego.h"
#include "drivers/control/pedals.h"
#include "drivers/way/path.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::drivers {

/// Somebody who stands or drives on our path.
struct Overlap {
    double s = 0;      ///< where it begins, along the path
    double speed = 0;  ///< [m/s] along the path
    std::uint32_t id = 0;
};

/// Everybody else on the road, as far as they concern our path.
///
/// MUST    find all whose footprint lies in the corridor that our car sweeps, and those who will be
///         there when we are (1.5 s ahead); say how hard to brake for the worst of them.
/// ASSUMES cars on a lane follow it; everything else goes on as it moves and turns now.
/// GOES    a box around the path culls most; a coarse polyline (4 m) culls nearly all; what is left
///         is tested sample by sample: cross-section of the corridor against the oriented box.
/// KEEPS   nothing from tick to tick but its buffers.
class Hazards {
  public:
    explicit Hazards(const world::TownT& town);

    /// [m] Left between our side and theirs.
    enum class Room : std::uint8_t {
        ample,  ///< 0.3
        close,  ///< 0.2 beside what has wheels and stands: of one who creeps
        bare,   ///< 0.1 likewise
    };

    /// About 5 us with 100 cars. The path must reach as far as the sight. `swept`: what a long
    /// vehicle sweeps, for each sample of the path; empty: the car's width everywhere.
    void look(const world::TickView& last,
              const Ego& ego,
              const Path& path,
              const DrivingStyle& style,
              std::span<const SweptWidth> swept = {},
              Room room = Room::ample);

    /// [m/s^2] the least of what all of them allow; infinity on an empty road.
    double acceleration() const { return acceleration_; }

    /// Those on the path now, in the order of vehicles, cars, walkers.
    std::span<const Overlap> overlaps() const { return overlaps_; }

  private:
    struct Scene;

    void make_corridor(const Ego& ego, const Path& path, const DrivingStyle& style);
    SweptWidth corridor_at(const Path& path, std::size_t sample) const;
    bool swings_out(const Body& body) const;
    void consider(const Body& body, const Scene& scene);
    void foresee(const Body& body, const Scene& scene, double distance);
    bool is_swung_into(const Body& body, const Ego& ego) const;
    double let_past(double contact, double left, const Scene& scene) const;
    bool place_after(const Body& body, double time, Body& moved) const;
    double first_contact(const Body& one, const Path& path) const;
    double coarse_distance(const Eigen::Vector2d& p_world) const;

    const world::TownT* town_;
    std::vector<Eigen::Vector2d> coarse_;  ///< every 4 m of path in sight
    std::vector<std::size_t> coarse_index_;
    world::Box box_;  ///< around them
    std::vector<Body> bodies_;
    double sight_start_ = 0;
    double half_width_ = 0;                       ///< of the corridor, where it is widest
    const world::VehicleModel* model_ = nullptr;  ///< of ours, while looking
    std::span<const SweptWidth> swept_;           ///< while looking
    double side_margin_ = 0;                      ///< [m] while looking
    double horizon_ = 0;                          ///< [s] of foresight, while looking
    std::vector<Overlap> overlaps_;
    double acceleration_ = std::numeric_limits<double>::infinity();
};

}  // namespace reprise::drivers
