#include <array>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/words/handles.h"
#include "scripting/words/vocabulary.h"
#include "world/models/catalogue.h"
#include "world/models/doors.h"

// What an actor carries, and is told to use: its lamps and doors.
namespace reprise::scripting {

namespace {

constexpr Key door_key_rows[] = {
    {"front_left", "boolean", "true: open, false: shut"},
    {"front_right", "boolean", "true: open, false: shut"},
    {"rear_left", "boolean", "true: open, false: shut"},
    {"rear_right", "boolean", "true: open, false: shut"},
};

constexpr Key lamp_key_rows[] = {
    {"left", "boolean", "the indicators on the left"},
    {"right", "boolean", "on the right"},
    {"hazard", "boolean", "on both sides"},
    {"low_beam", "boolean", "headlights"},
    {"brake", "boolean", "brake lamps"},
    {"reverse", "boolean", "reversing lamps"},
    {"beacon", "boolean", "the blue lamps of 'police' and 'ambulance': traffic makes way"},
};

struct LampWord {
    const char* key;
    std::uint16_t bits;
};

constexpr std::array<LampWord, 7> lamp_words{{{"left", world::lamp_left},
                                              {"right", world::lamp_right},
                                              {"hazard", world::lamp_left | world::lamp_right},
                                              {"low_beam", world::lamp_low_beam},
                                              {"brake", world::lamp_brake},
                                              {"reverse", world::lamp_reverse},
                                              {"beacon", world::lamp_beacon}}};

constexpr std::array<const char*, world::door_count> door_words{
    "front_left", "front_right", "rear_left", "rear_right"};

/// What is named is opened or shut; the others stay as they were told last.
int set_doors(Run& run, lua_State* L) {
    Actor& actor = actor_at(run, L, 1, "set_doors");
    if (actor.is_walker() || actor.is_prop())
        refuse("set_doors", "'" + actor.name + "' is a " + (actor.is_prop() ? "prop" : "walker"));
    const world::VehicleModel& model = world::vehicle_models()[actor.model];
    const Fields fields(
        L, 2, "set_doors", std::vector<std::string>(door_words.begin(), door_words.end()));
    std::uint8_t doors = actor.open_doors;
    bool any = false;
    for (std::uint8_t door = 0; door < world::door_count; ++door) {
        const auto open = fields.flag(door_words[door]);
        if (!open)
            continue;
        any = true;
        if (!world::has_door(model, door))
            refuse("set_doors",
                   fmt::format("model '{}' has no door '{}'", model.name, door_words[door]));
        const auto bit = static_cast<std::uint8_t>(1U << door);
        doors = static_cast<std::uint8_t>(*open ? doors | bit : doors & ~bit);
    }
    if (!any)
        refuse("set_doors",
               fmt::format("names no door: {}:set_doors{{ front_left = true }}", actor.name));
    actor.open_doors = doors;
    run.say(L, world::CommandKind::set_doors, actor.id).doors = doors;
    return 0;
}

Actor& with_lamps(Run& run, lua_State* L) {
    Actor& actor = actor_at(run, L, 1, "set_lamps");
    if (actor.is_walker() || actor.is_prop())
        refuse("set_lamps", "'" + actor.name + "' is a " + (actor.is_prop() ? "prop" : "walker"));
    if (actor.driver == world::Driver::parked)
        refuse("set_lamps",
               "'" + actor.name + "' is parked: its lamps are off (take driver = 'manual')");
    return actor;
}

/// What is named is the scenario's from now on; with nothing all are the driver's again.
int set_lamps(Run& run, lua_State* L) {
    const Actor& actor = with_lamps(run, L);
    std::uint16_t lamps = 0;
    std::uint16_t mask = 0;
    if (!lua_isnoneornil(L, 2)) {
        std::vector<std::string> keys;
        for (const LampWord& word : lamp_words)
            keys.emplace_back(word.key);
        const Fields fields(L, 2, "set_lamps", keys);
        for (const LampWord& word : lamp_words) {
            const auto on = fields.flag(word.key);
            if (!on)
                continue;
            if ((mask & word.bits) != 0)
                refuse("set_lamps", "'hazard' is both indicators: give it, or 'left' and 'right'");
            const world::VehicleModel& model = world::vehicle_models()[actor.model];
            if (word.bits == world::lamp_beacon && !world::has_beacon(model))
                refuse(
                    "set_lamps",
                    fmt::format("a {} has no beacon: 'police' and 'ambulance' have", model.name));
            mask |= word.bits;
            if (*on)
                lamps |= word.bits;
        }
        if (mask == 0)
            refuse("set_lamps",
                   fmt::format("names no lamp: {}:set_lamps{{ hazard = true }}, or {}:set_lamps() "
                               "to leave them all to the driver",
                               actor.name,
                               actor.name));
    }
    world::CommandT& command = run.say(L, world::CommandKind::set_lamps, actor.id);
    command.lamps = lamps;
    command.lamps_mask = mask;
    return 0;
}

constexpr Word equipment_rows[] = {
    {"set_doors",
     commanding<set_doors>,
     "(doors: DoorOptions)",
     "true opens, false shuts; what is not named stays"},
    {"set_lamps",
     commanding<set_lamps>,
     "(lamps?: LampOptions)",
     "true or false, as the scenario says from now on; without a table: the driver's again"},
};

}  // namespace

constinit const WordList equipment_words{Owner::actor, "Actors: lamps and doors", equipment_rows};
constinit const KeyList door_keys{"DoorOptions", "set_doors", door_key_rows};
constinit const KeyList lamp_keys{"LampOptions", "set_lamps", lamp_key_rows};

void add_equipment_words(lua_State* L) {
    add_words(L, equipment_words);
}

}  // namespace reprise::scripting
