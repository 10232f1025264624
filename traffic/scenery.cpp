#include "traffic/scenery.h"

#include "traffic/buildings.h"
#include "traffic/drawn_buildings.h"
#include "traffic/gardens.h"
#include "traffic/heads.h"
#include "traffic/land.h"
#include "traffic/parapets.h"
#include "traffic/parked_cars.h"
#include "traffic/plants.h"
#include "traffic/plots.h"
#include "traffic/signs.h"
#include "traffic/spawn_points.h"
#include "traffic/street_furniture.h"

namespace reprise::traffic {

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

}  // namespace reprise::traffic
