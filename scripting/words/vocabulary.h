#pragma once

struct lua_State;

namespace reprise::scripting {

/// All words of a scenario that are said in C++, into the table at the top of the stack.
/// The list for readers is scripting/vocabulary.md.
void add_vocabulary(lua_State* L);

/// Parts of it, one a file.
void add_header_words(lua_State* L);        ///< header_words.cpp: `scenario`
void add_task_words(lua_State* L);          ///< task_words.cpp: wait, start, finish, ...
void add_check_words(lua_State* L);         ///< check_words.cpp: the table `check`
void add_spawn_words(lua_State* L);         ///< spawning.cpp
void add_environment_words(lua_State* L);  ///< environment.cpp: weather and signals
void add_handle_words(lua_State* L);        ///< handles.cpp: an actor's methods that look
void add_drive_words(lua_State* L);         ///< drives.cpp: an actor's methods that act
                                            ///< (into the table of methods)
void add_equipment_words(lua_State* L);     ///< equipment.cpp: lamps (into the table of methods)

}  // namespace reprise::scripting
