#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "traffic/cars/cars.h"
#include "traffic/roads/lane_lines.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sight/foresight.h"
#include "traffic/sight/met_driver.h"
#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::traffic {

/// Where those who could meet are, and how far their bodies come: what decides about most pairs.
/// Keeps what was worked out for who stands, which decides nothing but the cost: a quarter of the
/// cars stands. Private to Meetings.
class MeetingPlaces {
  public:
    /// One of them, side by side in memory.
    struct Place {
        double x = 0;      ///< [m] of its middle
        double reach = 0;  ///< [m]
        world::Box area;   ///< that its body does not leave
        std::uint32_t lane = 0;
        std::uint32_t driver = 0;  ///< index
        bool is_turning = false;   ///< or will be in a moment
    };

    /// Both must outlive this.
    MeetingPlaces(const LaneLines& lines, const RoadGraph& graph);

    /// drivers[i] is of cars[i], as it is now.
    void gather(std::span<const Car> cars, std::span<const MetDriver> drivers);

    /// By `x`, then by the cars' ids.
    const std::vector<Place>& all() const { return places_; }

    /// Of cars[index], along its way.
    Foresight* foresight(std::size_t index, const MetDriver& driver);

    /// Is cars[index] the one that was gathered, and where it was then, if it takes part?
    bool has_stayed(std::size_t index, const Car& car, bool takes_part) const;

  private:
    /// All of a car that its place and its way follow from.
    struct Pose {
        std::uint32_t lane = 0;
        std::uint16_t model = 0;
        double lane_position = 0;
        double speed = 0;
        double yaw = 0;
        double travelled = 0;
        std::uint64_t trail = 0;  ///< digest of its points
        Eigen::Vector3d front = Eigen::Vector3d::Zero();
        Eigen::Vector3d rear = Eigen::Vector3d::Zero();
        std::vector<std::uint32_t> route;

        bool is_of(const Car& car) const;
        void take(const Car& car);
    };

    /// Of a car, for as long as it stays where it is.
    struct Memory {
        std::uint32_t id = 0;
        Pose pose;
        Place place;
        Foresight foresight;
        bool is_foreseen = false;
    };

    void remember(std::span<const Car> cars);
    Place place_of(const Car& car, const MetDriver& driver) const;
    bool is_between_lanes(const Car& car) const;

    const LaneLines* lines_;
    const RoadGraph* graph_;
    std::vector<bool> crosses_;  ///< by lane outside of a junction: another road's runs over it
    std::vector<Place> places_;
    std::vector<std::unique_ptr<Memory>> memories_;  ///< [i] of cars[i]
};

}  // namespace reprise::traffic
