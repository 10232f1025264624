#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "world/geometry2d.h"

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// A road between two junctions, cut into steps of at most 5 m. Both directions of a road are one.
struct Chain {
    std::vector<std::uint32_t> points;    ///< from the point of one junction to that of the other
    std::vector<Eigen::Vector2d> places;  ///< of the points; the ends are the road's, not the
                                          ///< middles of the junctions. [m]
};

/// Where vehicles or walkers go: an edge, or a path through a junction.
struct Track {
    world::Loop line;                   ///< open, in the middle of its lanes, in plan. [m]
    double half_width = 0;              ///< [m] of all lanes together
    std::vector<std::uint32_t> points;  ///< of its chain, in its direction; the junction's one
    std::vector<std::string> ways;      ///< of the map, that the road was made of (origId)
    std::uint32_t chain = 0;            ///< world::none in a junction
};

/// An edge on its chain.
struct OnChain {
    std::uint32_t chain = 0;
    bool reversed = false;
};

/// A road network as a graph of points, each of which can be given a height. One point for each
/// junction: all of a junction is level. Nothing is known of heights here.
struct RoadChains {
    struct Step {
        std::uint32_t to = 0;
        double length = 0;  ///< [m] less near junctions and in bends, where ramps must be gentle
    };

    std::vector<Eigen::Vector2d> places;   ///< of each point. [m]
    std::vector<std::vector<Step>> steps;  ///< from each point, both ways
    std::vector<Chain> chains;
    std::vector<Track> tracks;
    std::map<std::string, std::uint32_t> junctions;  ///< id: point
    std::map<std::string, OnChain> edges;            ///< id: of ordinary edges
};

RoadChains read_road_chains(const pugi::xml_node& net);

/// Makes points nearly one: whatever height one of them gets, all get.
void keep_together(RoadChains& roads, const std::vector<std::uint32_t>& points);

/// A point to measure from.
struct Source {
    std::uint32_t point = 0;
    double head_start = 0;  ///< [m] added to all distances from there; may be negative
};

/// From the nearest of `sources` to each point, along the roads; `farthest` where that is more.
/// [m]
std::vector<double> distances(const RoadChains& roads,
                              const std::vector<Source>& sources,
                              double farthest);

/// Of an open line. [m]
double plan_length(const world::Loop& line);

struct LinePoint {
    Eigen::Vector2d place;
    Eigen::Vector2d direction;  ///< of length 1
};

/// At a share of an open line's length, 0 to 1.
LinePoint point_along(const world::Loop& line, double share);

}  // namespace reprise::towns
