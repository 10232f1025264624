#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "towns/maps/reference_line.h"
#include "towns/maps/signal_words.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// A signal or sign of an OpenDRIVE road.
struct RoadSignal {
    using Kind = SignalKind;

    std::string id;
    Kind kind = Kind::light;
    world::Vec3 foot;      ///< where its pole stands on the road's surface, in the map's frame
    double heading = 0;    ///< [rad] of the road there, the offset of the signal added
    bool against = false;  ///< orientation "-": for those who drive against s
    double bottom = 0;     ///< [m] of its lower edge above the road, as the map says (zOffset)
    double height = 0;     ///< [m] from its lower to its upper edge
    double limit_kmh = 0;  ///< speed_limit only
};

/// Of an OpenDRIVE road, where it runs.
struct MapRoad {
    ReferenceLine line;
    double length = 0;  ///< [m] of it
};

/// What netconvert does not take over from an OpenDRIVE map.
struct OpenDrive {
    std::string version;                     ///< such as 1.4
    std::map<std::string, MapRoad> roads;    ///< by id
    std::vector<RoadSignal> signals;         ///< in the order of the file
    std::vector<Eigen::Vector3d> crossings;  ///< crosswalks, in the map's frame
    int other_signs = 0;                     ///< of kinds that towns do not have
    int limits_set = 0;                      ///< lanes that got their road's limit
    int banked = 0;  ///< roads with superelevation: netconvert lays them flat
    /// [m] The header's <offset>: netconvert subtracts it from every coordinate, if it knows the
    /// map's projection.
    Eigen::Vector2d origin{0, 0};
    /// All roads have rule="LHT": then all that stands here is mirrored about the x axis, as if
    /// traffic drove on the right.
    bool left_hand = false;
    std::string prepared;  ///< the map with these limits, for netconvert
};

/// Parses a map. netconvert 1.15 ignores speed limits of a whole road (<type><speed>): they are
/// written into its lanes; and direct junctions, which get connecting roads. Road names that an
/// editor generated are removed. `file` is for messages.
/// Throws world::Error "file:line: what" when it is not XML, has no road, or drives on both sides.
OpenDrive read_opendrive(const std::string& xml, const std::string& file);

}  // namespace reprise::towns
