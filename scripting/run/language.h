#pragma once

#include <vector>

#include "scripting/run/word.h"

namespace reprise::scripting {

/// The whole language, family by family, and every table of keys.
std::vector<WordList> vocabulary();
std::vector<KeyList> vocabulary_keys();

// Its families, each defined where its words are, and all of them in vocabulary().
extern const WordList header_words;
extern const WordList task_words;
extern const WordList task_methods;
extern const WordList spawn_words;
extern const WordList place_words;
extern const WordList road_words;  ///< road_words.cpp
extern const WordList actor_looks;
extern const WordList actor_orders;
extern const WordList pair_words;
extern const WordList check_words;
extern const WordList sight_words;
extern const WordList junction_words;
extern const WordList environment_words;
extern const WordList equipment_words;
extern const WordList placing_words;
extern const WordList motion_words;
extern const WordList meeting_words;
extern const WordList other_words;
extern const WordList branch_words;  ///< of scripts that take over from another only

extern const KeyList header_keys;
extern const KeyList wait_keys;
extern const KeyList spawn_keys;
extern const KeyList sensor_keys;
extern const KeyList over_keys;
extern const KeyList route_keys;
extern const KeyList walk_keys;
extern const KeyList walk_to_keys;
extern const KeyList control_keys;
extern const KeyList pick_lane_keys;
extern const KeyList check_keys;  ///< of checks that have no deadline
extern const KeyList around_keys;
extern const KeyList ttc_keys;
extern const KeyList pick_junction_keys;
extern const KeyList pick_crossing_keys;
extern const KeyList set_weather_keys;
extern const KeyList set_signal_keys;
extern const KeyList green_keys;
extern const KeyList door_keys;
extern const KeyList lamp_keys;
extern const KeyList follow_keys;
extern const KeyList teleport_keys;
extern const KeyList arrive_keys;
extern const KeyList deadline_keys;  ///< of check.eventually

}  // namespace reprise::scripting
