#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "world/town.h"

namespace reprise::world {

/// A place as OpenDRIVE says it.
struct RoadPlace {
    std::string road;  ///< the road's id
    int lane = 0;      ///< negative to the right of the road's reference line
    double s = 0;      ///< [m] along the reference line
};

/// What a lane of ours has of a lane of an OpenDRIVE road. Between two knots both grow evenly, to
/// within 5 cm: more of them stand where the road bends.
struct RoadPiece {
    struct Knot {
        double s = 0;       ///< [m] along our lane
        double road_s = 0;  ///< [m] along the road's reference line
    };

    std::string road;
    int lane = 0;
    std::vector<Knot> knots;  ///< two at least, by s
};

/// Along the lane, mostly one; none where the town was no OpenDRIVE map.
std::vector<RoadPiece> road_pieces(const LaneT& lane);

/// Fills road, road_lane, road_s and road_s_end. What two numbers cannot say, several roads or one
/// that bends to both sides, stands behind a bar in `road`: "12 13|12 -1 0.00:3.20 ...;13 1 ...".
void set_road_pieces(LaneT& lane, const std::vector<RoadPiece>& pieces);

/// "12 -1 0.00:3.20 50.00:53.20;13 1 ...": each road with its lane and knots; and back. What is not
/// of this form is left out.
std::string road_pieces_text(const std::vector<RoadPiece>& pieces);
std::vector<RoadPiece> read_road_pieces(std::string_view text);

/// A place on a lane of ours, in the OpenDRIVE map's words. `s` is clamped to the lane.
std::optional<RoadPlace> road_place(const LaneT& lane, double s);

/// A place on our lanes.
struct FoundPlace {
    std::uint32_t lane = 0;  ///< in town.lanes
    double s = 0;            ///< [m]
};

/// Where that is, or nothing: no such road or lane, or a part of it that lies in a junction, which
/// has lanes of its own. Where lanes that lead to a junction and those inside it overlap, the
/// former count.
std::optional<FoundPlace> find_road_place(const TownT& town, const RoadPlace& place);

/// As above, or throws world::Error that says what there is of that road.
FoundPlace road_place_named(const TownT& town, const RoadPlace& place);

}  // namespace reprise::world
