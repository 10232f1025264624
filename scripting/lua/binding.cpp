#include "scripting/lua/binding.h"

#include <lua.hpp>

#include "scripting/lua/limits.h"

namespace reprise::scripting {

namespace {

/// [instructions] of a mistake that the script may catch: an exception, and the search for what was
/// probably meant.
constexpr std::uint64_t mistake_cost = 5000;

}  // namespace

int report(lua_State* L, const std::string& message) {
    Vm& vm = Vm::of(L);
    vm.charge_later(mistake_cost);
    const bool placed = message.rfind(vm.script() + ":", 0) == 0;
    vm.raise(L, placed ? message : vm.position(L) + message);
}

int report_ours(lua_State* L, std::exception_ptr ours) {
    Vm& vm = Vm::of(L);
    vm.latch(std::move(ours));
    vm.raise(L, "");
}

void add_function(lua_State* L, const char* name, int (*function)(lua_State*)) {
    add_closure(L, name, function);
}

}  // namespace reprise::scripting
