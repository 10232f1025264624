#include "towns/scenery.h"

#include "towns/buildings/buildings.h"
#include "towns/buildings/drawn_buildings.h"
#include "towns/buildings/gardens.h"
#include "towns/buildings/plots.h"
#include "towns/furnish/heads.h"
#include "towns/furnish/land.h"
#include "towns/furnish/parapets.h"
#include "towns/furnish/parked_cars.h"
#include "towns/furnish/plants.h"
#include "towns/furnish/signs.h"
#include "towns/furnish/spawn_points.h"
#include "towns/furnish/street_furniture.h"

namespace reprise::towns {

void place_scenery(world::TownT& town,
                   const Place& place,
                   const std::vector<GiveWay>& right_of_way) {
    Land land(town, place, right_of_way);
    // What drivers need first; then what takes the most room; what finds a place anywhere last.
    place_heads(land);
    place_signs(land);
    lay_out_plots(land);
    keep_drawn_buildings(land);
    const std::vector<Lot> lots = place_buildings(land);
    place_parapets(land);
    place_bus_stops(land);
    place_street_lights(land);
    lay_out_gardens(land, lots);
    place_street_trees(land);
    park_along_wide_lanes(land);
    place_small_furniture(land);
    place_spawn_points(land);
}

}  // namespace reprise::towns
