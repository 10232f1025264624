#pragma once

#include <string>
#include <vector>

#include "scripting/run/language.h"

struct lua_State;

namespace reprise::scripting {

/// All words of a scenario that are said in C++, into the table at the top of the stack.
/// The list for readers is scripting/vocabulary.md.
void add_vocabulary(lua_State* L);

/// Parts of it, one a file.
void add_header_words(lua_State* L);       ///< header_words.cpp: `scenario`
void add_task_words(lua_State* L);         ///< task_words.cpp: wait, start, finish, ...
void add_check_words(lua_State* L);        ///< check_words.cpp: the table `check`
void add_spawn_words(lua_State* L);        ///< spawning.cpp
void add_environment_words(lua_State* L);  ///< environment.cpp: weather and signals
void add_place_words(lua_State* L);        ///< place_words.cpp: lanes, junctions, crossings
void add_meeting_words(lua_State* L);      ///< meetings.cpp: for the prelude's arrive_together
// Into the table of an actor's methods:
void add_handle_words(lua_State* L);     ///< handles.cpp: those that look
void add_look_words(lua_State* L);       ///< looks.cpp: those that look around
void add_drive_words(lua_State* L);      ///< drives.cpp: those that act
void add_motion_words(lua_State* L);     ///< motion.cpp: of these, speed and lateral motion
void add_equipment_words(lua_State* L);  ///< equipment.cpp: lamps and doors
void add_placing_words(lua_State* L);    ///< follow.cpp: those that put it somewhere

/// What `driver =` may be, in the order of world::Driver.
const std::vector<std::string>& driver_names();

}  // namespace reprise::scripting
