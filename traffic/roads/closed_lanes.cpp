#include "traffic/roads/closed_lanes.h"

#include <algorithm>
#include <string>
#include <vector>

#include <libsumo/libsumo.h>

#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

/// What SUMO calls the classes of all that we let it drive.
std::vector<std::string> classes_of_fleet() {
    std::vector<std::string> classes;
    for (const world::VehicleModel& model : world::vehicle_models())
        classes.emplace_back(model.sumo_class);
    std::sort(classes.begin(), classes.end());
    classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
    return classes;
}

}  // namespace

void close_other_lanes(const world::TownT& town) {
    const std::vector<std::string> fleet = classes_of_fleet();
    for (const world::LaneT& lane : town.lanes) {
        if (world::is_for_cars(lane) || lane.kind == world::LaneKind::walking_area ||
            lane.kind == world::LaneKind::crossing)
            continue;
        const std::vector<std::string> allowed = libsumo::Lane::getAllowed(lane.name);
        if (std::any_of(fleet.begin(), fleet.end(), [&](const std::string& name) {
                return allowed.empty() ||
                       std::find(allowed.begin(), allowed.end(), name) != allowed.end();
            }))
            libsumo::Lane::setDisallowed(lane.name, fleet);
    }
}

}  // namespace reprise::traffic
