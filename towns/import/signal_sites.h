#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "towns/maps/opendrive.h"
#include "towns/network/place.h"

namespace reprise::towns {

/// The roads of a network that netconvert made of an OpenDRIVE map.
struct ImportedRoads {
    world::TownT town;             ///< lanes, links, junctions and signals only
    Eigen::Vector2d offset{0, 0};  ///< [m] netconvert's: see offset_of()
    bool projected = false;        ///< netconvert knows where on earth it lies
    /// The map's ids of the lights that netconvert gave to each of town.signals.
    std::vector<std::vector<std::string>> lights;
};

/// Throws world::Error when the network is not XML.
ImportedRoads read_roads(const std::string& network, const std::string& file);

/// [m] From the map's coordinates to the network's.
Eigen::Vector2d offset_of(const OpenDrive& map, const ImportedRoads& roads);

/// A signal of the map, seen from the network.
struct SignalSite {
    const RoadSignal* signal = nullptr;
    world::Vec3 foot;                   ///< [m] in the network's coordinates
    double yaw = 0;                     ///< [rad] the way those drive who read it
    std::optional<std::uint32_t> lane;  ///< the driving lane beside which it stands, if any
};

/// One for each signal of the map, in its order. Maps disagree about what a signal's heading
/// means (the standard: relative to the orientation; RoadRunner and so CARLA: relative to the
/// road): the reading that puts more signals beside lanes of their direction is taken for the whole
/// map.
std::vector<SignalSite> site_signals(const OpenDrive& map, const ImportedRoads& roads);

/// What became of a map's signals.
struct SignalReport {
    int lights = 0;  ///< in the map
    int heads = 0;   ///< that stand where the map says
    int signs = 0;   ///< likewise
    int shared = 0;  ///< lights beside another one, which shows what they would
    int moved = 0;   ///< poles that stood on the road
    int lost = 0;    ///< that control nothing, or found no place beside the road
};

/// Puts a head for each light that controls something, and the signs, into the place.
SignalReport place_signals(const OpenDrive& map, const ImportedRoads& roads, Place& place);

}  // namespace reprise::towns
