#pragma once

#include <vector>

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// A building whose front faces a street: gardens and forecourts are laid out around it.
struct StreetBuilding {
    std::uint32_t building = 0;  ///< index in town.buildings
    std::uint32_t roadside = 0;  ///< index in context.roadsides
    double setback = 0;          ///< [m] from the border to its front
};

/// Fills town.buildings; leaves it empty where the place knows the real ones. They stand in rows
/// along the roads, their fronts to the street, terraces and shops without gaps behind the
/// sidewalk, houses 4 to 7 m back, chosen by district and street; taller ones behind them; one
/// church, town hall, school, fire station and market hall near the middle of a town. They stand
/// clear of all that is driven and walked on, of plots and of the sight triangles of unlit
/// junctions.
std::vector<StreetBuilding> place_buildings(PlacementContext& context);

}  // namespace reprise::towns
