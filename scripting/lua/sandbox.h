#pragma once

struct lua_State;

namespace reprise::scripting {

/// Pushes two tables: the vocabulary (Lua's safe functions; the rooms' words are added to it) and
/// the environment of a script, which shows the vocabulary and refuses everything else: reading a
/// word that is not there, writing any.
///
/// Left out of Lua, because its answers differ from run to run or it reaches out of the machine:
/// os, io, debug, package, coroutine, load*, dofile, require, collectgarbage, math.random,
/// string.dump, addresses in texts, finalizers and weak tables. See scripting/vocabulary.md.
void push_sandbox(lua_State* L);

/// Makes the table at the top of the stack refuse words that it does not hold: "check has no
/// 'nevr' (did you mean 'never'?)".
void refuse_unknown(lua_State* L, const char* name);

}  // namespace reprise::scripting
