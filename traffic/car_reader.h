#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/road_graph.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Reads SUMO's cars after its step, and writes them into the tick.
class CarReader {
  public:
    /// `town` and `graph` must outlive this. `step` [s] of a tick; `seed` of the cars' looks.
    CarReader(const world::TownT& town, const RoadGraph& graph, double step, std::uint64_t seed);

    /// What SUMO made of these cars in this tick. Others may be read in another thread meanwhile:
    /// of a vehicle SUMO's getters change nothing but what that one keeps.
    void read(std::span<Car> cars, std::uint64_t tick) const;

    /// next.traffic.cars and their looks, on the record's grid.
    void write(const Cars& cars, const world::TickView& last, world::TickDraft& next) const;

    /// [rad] that a body at `yaw` shows a tick later, whose bumper lies in the direction `wanted`:
    /// it turns there not at once where a lane turns back on the spot, as some maps draw them.
    static double turned(double yaw, double wanted, double step);

  private:
    /// What is asked of a lane in every tick, side by side.
    struct Measures {
        double length = 0;       ///< [m]
        double sumo_length = 0;  ///< [m]
        double inside = 0;       ///< [m] in SUMO's measure: who has come no further is on its road
        std::uint32_t index = 0;
        bool is_alone = false;  ///< there is no other lane of its road to change to
    };

    double position_of(const Car& car, double speed) const;
    void read_car(Car& car, std::uint64_t tick) const;
    void read_lane(Car& car, bool on_its_road) const;
    void enter_lane(Car& car, std::string_view lane) const;
    Eigen::Vector3d bumper_of(const Car& car) const;
    bool is_straight(const Car& car) const;
    void move_aside(Car& car, std::uint64_t tick) const;
    double lane_yaw_of(const Car& car) const;
    double even_lane_yaw_of(const Car& car) const;
    Eigen::Vector2d aside_of(const Car& car) const;
    Eigen::Vector3d without_jumps(Car& car, const Eigen::Vector3d& sumo_front) const;
    void move_body(Car& car) const;
    Eigen::Vector3d rolled(const Car& car, const Eigen::Vector3d& wanted) const;

    const world::TownT* town_;
    const RoadGraph* graph_;
    double step_;
    double sumo_step_;  ///< [s] likewise, as SUMO computes it from milliseconds
    std::uint64_t seed_;
    std::unordered_map<std::string_view, std::uint32_t> lanes_by_name_;  ///< never iterated
    std::vector<Measures> measures_;                                     ///< [lane]
};

}  // namespace reprise::traffic
