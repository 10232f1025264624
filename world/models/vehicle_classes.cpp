#include "world/models/vehicle_classes.h"

#include <algorithm>

#include "world/words.h"

namespace reprise::world {

const std::vector<std::string_view>& vehicle_class_names() {
    // SUMO 1.15, src/utils/common/SUMOVehicleClass.cpp.
    static const std::vector<std::string_view> names{
        "passenger",     "private",   "taxi",       "bus",     "coach",    "delivery",   "truck",
        "trailer",       "emergency", "motorcycle", "moped",   "bicycle",  "pedestrian", "tram",
        "rail_electric", "rail_fast", "rail_urban", "rail",    "evehicle", "army",       "ship",
        "authority",     "vip",       "hov",        "custom1", "custom2"};
    return names;
}

ClassSet class_bit(std::string_view name) {
    const auto& names = vehicle_class_names();
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? 0 : ClassSet{1} << (found - names.begin());
}

namespace {

ClassSet class_set(std::string_view list) {
    const ClassSet all = (ClassSet{1} << vehicle_class_names().size()) - 1;
    ClassSet set = 0;
    for (const std::string_view word : words(list))
        set |= word == "all" ? all : class_bit(word);
    return set;
}

}  // namespace

ClassSet permitted(std::string_view allow, std::string_view disallow) {
    const ClassSet all = class_set("all");
    return allow.empty() ? all & ~class_set(disallow) : class_set(allow);
}

}  // namespace reprise::world
