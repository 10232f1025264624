#include <lua.hpp>

#include "scripting/lua/binding.h"
#include "scripting/lua/sandbox.h"
#include "scripting/run/run.h"
#include "scripting/words/vocabulary.h"

namespace reprise::scripting {

namespace {

using Kind = Checks::Kind;

template <Checks::Kind kind>
int add_check(Run& run, lua_State* L) {
    run.checks.add(run, L, kind);
    return 0;
}

constexpr Word check_rows[] = {
    {"never",
     acting<add_check<Kind::never>>,
     "(name: string, predicate?: (fun(): any)|CheckOptions, options?: CheckOptions)",
     "fails in the first tick in which the predicate is true; 'blocked' needs none"},
    {"always",
     acting<add_check<Kind::always>>,
     "(name: string, predicate: (fun(): any), options?: CheckOptions)",
     "fails in the first tick in which the predicate is false"},
    {"max",
     acting<add_check<Kind::max>>,
     "(name: string, measure: (fun(): number?), limit: number, options?: CheckOptions)",
     "fails in the first tick in which the measure is above the limit"},
    {"min",
     acting<add_check<Kind::min>>,
     "(name: string, measure: (fun(): number?), limit: number, options?: CheckOptions)",
     "fails in the first tick in which the measure is below the limit"},
    {"eventually",
     acting<add_check<Kind::eventually>>,
     "(name: string, predicate: (fun(): any), options?: DeadlineOptions)",
     "fails when the predicate was not true in time, or until the end"},
    {"at_end",
     acting<add_check<Kind::at_end>>,
     "(name: string, predicate: (fun(): any), options?: CheckOptions)",
     "fails when the predicate is false in the last tick"},
};

}  // namespace

constinit const WordList check_words{Owner::check, "Promises", check_rows};

void add_check_words(lua_State* L) {
    lua_newtable(L);
    add_words(L, check_words);
    refuse_unknown(L, "check");
    lua_setfield(L, -2, "check");
}

}  // namespace reprise::scripting
