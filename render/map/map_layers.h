// Private to the room: the layers of a map, in the order in which they are painted.
#pragma once

#include "ground/mesh/ground.h"
#include "render/map/map_canvas.h"
#include "world/town.h"

namespace reprise::render {

inline constexpr Ink land_ink{230, 234, 214};

/// A line of the legend.
struct LegendEntry {
    enum class Shape { area, disc, arrow, signal, car, walker, sign };

    Shape shape = Shape::area;
    Ink ink;
    std::string text;
};

/// What this town has, of all that a map may show.
std::vector<LegendEntry> legend_of(const world::TownT& town);

Ink plot_ink(world::PlotKind kind);
Ink road_ink(double speed_limit);

/// The terrain, brighter where it slopes to the north-west, and on it parks, squares, water...
void draw_land(const world::TownT& town, const ground::GroundMesh& ground, MapCanvas& canvas);

/// Roads, sidewalks and kerbs, lower storeys first.
void draw_roads(const world::TownT& town, const ground::GroundMesh& ground, MapCanvas& canvas);

/// Painted lines that no bridge hides, and an arrow here and there for the way that lanes go.
void draw_markings(const world::TownT& town,
                   const ground::GroundMesh& ground,
                   const ground::GroundMesh& markings,
                   MapCanvas& canvas);

void draw_buildings(const world::TownT& town, MapCanvas& canvas);
void draw_plants(const world::TownT& town, MapCanvas& canvas);
void draw_furniture(const world::TownT& town, MapCanvas& canvas);
void draw_spawn_points(const world::TownT& town, MapCanvas& canvas);
void draw_signals(const world::TownT& town, MapCanvas& canvas);

/// Names of streets (or edges) and of junctions, as far as there is room.
void draw_names(const world::TownT& town, MapCanvas& canvas);

/// Heading, legend, scale bar and north arrow.
void draw_frame(const world::TownT& town,
                const std::vector<LegendEntry>& legend,
                MapCanvas& canvas);

/// How many rows a legend takes on a sheet.
int legend_rows(const std::vector<LegendEntry>& legend);

}  // namespace reprise::render
