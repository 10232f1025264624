#pragma once

#include <cstdint>
#include <optional>

#include "scripting/run/actors.h"
#include "world/town.h"

namespace reprise::scripting {

/// Pure functions over two bodies.

/// How far apart two bodies are along the road. `ahead`: the other one is in front.
struct Gap {
    double length = 0;  ///< [m] bumper to bumper, 0 while they are side by side
    bool ahead = true;
    std::uint32_t searched = 0;  ///< lanes that the search for a way looked at
};

/// Where both are on one road - the same edge, or one reaches the other within 200 m by driving on
/// - measured along its centre lines, whatever the lane. Elsewhere (walkers off the lanes, opposite
/// directions, crossing roads) along the straight line of a's heading.
/// `lane` of both bodies should be set where known. About 1 us on one edge.
Gap gap(const world::TownT& town, const Body& a, const Body& b);

/// Where a body is on its lane, which must be known: as the tick says, or by its place.
world::LaneProjection place_on_lane(const world::TownT& town, const Body& body);

/// [m] between the centres of both bounding boxes.
double distance(const Body& a, const Body& b);

/// [m] between both outlines, across a's heading, wherever b is along it; negative by how far one
/// would have to move aside so that they could pass each other.
double lateral_gap(const Body& a, const Body& b);

/// Is b on the lane that a is on, or on one before or behind it that is reached without a change of
/// lanes; or does one of them reach `intrusion` metres or more into the lane of the other beside
/// it?
bool share_lane(const world::TownT& town, const Body& a, const Body& b);

inline constexpr double intrusion = 0.3;  ///< [m] as UN Regulation 157 (ALKS) counts a cut-in

/// [s] until the gap is closed when both keep their speed; infinite when it is not closing.
double time_to_collision(const world::TownT& town, const Body& a, const Body& b);
double time_to_collision(const Gap& between, const Body& a, const Body& b);

}  // namespace reprise::scripting
