#pragma once

#include <cstdint>

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// A piece of furniture that place_prop() may add: its footprint, and the distances it must keep.
struct PropCandidate {
    world::PropKind kind = world::PropKind::bench;
    Footprint footprint;
    double height = 1;
    double road_z = 0;        ///< of the road beside it
    double from_solid = 0.1;  ///< [m] from everything that stands
    double from_walk = -1;    ///< [m] from sidewalks; negative: it may stand on them
    std::uint32_t style = 0;
    std::uint16_t value = 0;
};

/// Parked cars stand level: there is no more height than that under one. [m]
inline constexpr double car_slope = 0.3;

/// Adds it to town.props when it stands clear: kerb_margin from the road, off crossings and
/// junctions, not in sight triangles when it is higher than 1 m, on ground that is even enough.
/// Fences, walls and hedges go down a slope in steps. False: it does not stand.
bool place_prop(PlacementContext& context, const PropCandidate& candidate);

}  // namespace reprise::towns
