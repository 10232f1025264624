#include "towns/scenery.h"

#include "towns/buildings/buildings.h"
#include "towns/buildings/drawn_buildings.h"
#include "towns/buildings/gardens.h"
#include "towns/buildings/plots.h"
#include "towns/furnish/heads.h"
#include "towns/furnish/parapets.h"
#include "towns/furnish/parked_cars.h"
#include "towns/furnish/placement_context.h"
#include "towns/furnish/plants.h"
#include "towns/furnish/signs.h"
#include "towns/furnish/spawn_points.h"
#include "towns/furnish/street_furniture.h"

namespace reprise::towns {

void place_scenery(world::TownT& town,
                   const Place& place,
                   const std::vector<GiveWay>& right_of_way) {
    PlacementContext context(town, place, right_of_way);
    // What drivers need first; then what takes the most room; what finds a place anywhere last.
    place_heads(context);
    place_signs(context);
    lay_out_plots(context);
    keep_drawn_buildings(context);
    const std::vector<StreetBuilding> street_buildings = place_buildings(context);
    place_parapets(context);
    place_bus_stops(context);
    place_street_lights(context);
    lay_out_gardens(context, street_buildings);
    place_street_trees(context);
    park_along_wide_lanes(context);
    place_small_furniture(context);
    place_spawn_points(context);
}

}  // namespace reprise::towns
