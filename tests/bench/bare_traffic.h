#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include <libsumo/libsumo.h>

#include "world/town.h"

namespace reprise::bench {

/// What it costs to ask libsumo for its cars, by the cheapest calls that it has: of each what a
/// tick records of it, of each traffic light its state. Of the simulation that this process runs.
class BareTraffic {
  public:
    explicit BareTraffic(const world::TownT& town) : lights_(libsumo::TrafficLight::getIDList()) {
        for (const world::LaneT& lane : town.lanes)
            lanes_.emplace(lane.name, static_cast<unsigned>(lanes_.size()));
    }

    /// As of the last step. About 0.6 us a car.
    void read() {
        cars_.clear();
        for (const std::string& id : libsumo::Vehicle::getIDList()) {
            const libsumo::TraCIPosition place = libsumo::Vehicle::getPosition3D(id);
            const auto lane = lanes_.find(libsumo::Vehicle::getLaneID(id));
            cars_.push_back({place.x,
                             place.y,
                             place.z,
                             libsumo::Vehicle::getAngle(id),
                             libsumo::Vehicle::getSpeed(id),
                             libsumo::Vehicle::getAcceleration(id),
                             libsumo::Vehicle::getLanePosition(id),
                             lane == lanes_.end() ? world::none : lane->second});
        }
        for (std::size_t i = 0; i < lights_.size(); ++i)
            states_[i] = libsumo::TrafficLight::getRedYellowGreenState(lights_[i]);
    }

  private:
    struct Car {
        double x, y, z, angle, speed, acceleration, lane_s;
        unsigned lane;
    };

    std::vector<std::string> lights_;
    std::vector<std::string> states_ = std::vector<std::string>(lights_.size());
    std::unordered_map<std::string, unsigned> lanes_;
    std::vector<Car> cars_;
};

}  // namespace reprise::bench
