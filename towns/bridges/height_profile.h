#pragma once

#include <string>
#include <vector>

#include "towns/bridges/road_chains.h"

namespace reprise::towns {

/// The heights of one road, from its start to its end, for all of its lanes: lanes beside each
/// other have the same height where they are beside each other.
class HeightProfile {
  public:
    /// `heights` are those of the network's points. [m]
    HeightProfile(const RoadChains& roads, const std::vector<double>& heights, const OnChain& road);

    bool is_flat() const;

    /// A lane's line (in plan, in the road's direction) as a shape for the network: with a point
    /// every 5 m, each with its height.
    std::vector<Eigen::Vector3d> lift(const world::Loop& line) const;

  private:
    double beside(const Eigen::Vector2d& place, double share) const;
    double at(const Eigen::Vector2d& place, double from_start, double length) const;

    std::vector<Eigen::Vector3d> line_;  ///< of the road
    double length_ = 0;                  ///< [m] in plan
};

/// The steepest piece of a line. [m/m]
double steepest(const std::vector<Eigen::Vector3d>& line);

/// "x,y,z x,y ...": z is left out where it is 0, as netconvert does. A line of one point comes out
/// with two at the same place: SUMO loads no lane with fewer.
std::string shape_text(const std::vector<Eigen::Vector3d>& line);

}  // namespace reprise::towns
