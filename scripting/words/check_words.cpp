#include <lua.hpp>

#include "scripting/lua/binding.h"
#include "scripting/lua/sandbox.h"
#include "scripting/words/run.h"
#include "scripting/words/vocabulary.h"

namespace reprise::scripting {

namespace {

using Kind = Checks::Kind;

template <Checks::Kind kind>
int add_check(Run& run, lua_State* L) {
    run.checks.add(run, L, kind);
    return 0;
}

}  // namespace

void add_check_words(lua_State* L) {
    lua_newtable(L);
    add_function(L, "never", acting<add_check<Kind::never>>);
    add_function(L, "always", acting<add_check<Kind::always>>);
    add_function(L, "max", acting<add_check<Kind::max>>);
    add_function(L, "min", acting<add_check<Kind::min>>);
    add_function(L, "eventually", acting<add_check<Kind::eventually>>);
    add_function(L, "at_end", acting<add_check<Kind::at_end>>);
    refuse_unknown(L, "check");
    lua_setfield(L, -2, "check");
}

}  // namespace reprise::scripting
