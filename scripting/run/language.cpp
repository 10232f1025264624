#include "scripting/run/language.h"

namespace reprise::scripting {

std::vector<WordList> vocabulary() {
    return {header_words,
            task_words,
            task_methods,
            spawn_words,
            actor_looks,
            sight_words,
            actor_orders,
            motion_words,
            placing_words,
            equipment_words,
            pair_words,
            meeting_words,
            environment_words,
            place_words,
            junction_words,
            road_words,
            check_words,
            other_words,
            branch_words};
}

std::vector<KeyList> vocabulary_keys() {
    return {header_keys,      wait_keys,       spawn_keys,   sensor_keys,        over_keys,
            route_keys,       walk_keys,       walk_to_keys, control_keys,       pick_lane_keys,
            check_keys,       around_keys,     ttc_keys,     pick_junction_keys, pick_crossing_keys,
            set_weather_keys, set_signal_keys, green_keys,   door_keys,          lamp_keys,
            follow_keys,      teleport_keys,   arrive_keys,  deadline_keys};
}

}  // namespace reprise::scripting
