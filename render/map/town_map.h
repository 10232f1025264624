#pragma once

#include "ground/mesh/ground.h"
#include "world/external/sensor.h"
#include "world/geometry2d.h"
#include "world/town_generated.h"

namespace reprise::render {

/// What a map shows, and how large.
struct MapView {
    world::Box region;  ///< [m] world; empty: the whole town
    int size = 1600;    ///< [pixels] of the longer side, 200 to 8000
};

/// A town seen from above, north up, as people draw maps: land, roads by speed limit, sidewalks,
/// crossings and markings from the same triangles that wheels roll on; plots, buildings, plants,
/// signals, signs and spawn points; lane directions, names where there is room, scale and legend.
/// Line widths are the town's own; symbols and letters keep their size whatever the scale is.
/// An rgb frame. Town 1 at 1600 pixels: 0.5 s.
world::SensorFrame town_map(const world::TownT& town,
                            const ground::GroundMesh& ground,
                            const ground::GroundMesh& markings,
                            const MapView& view);

}  // namespace reprise::render
