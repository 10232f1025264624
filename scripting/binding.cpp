#include "scripting/binding.h"

#include <lua.hpp>

namespace reprise::scripting {

int report(lua_State* L, const std::string& message) {
    Vm& vm = Vm::of(L);
    const bool placed = message.rfind(vm.script() + ":", 0) == 0;
    vm.raise(L, placed ? message : vm.position(L) + message);
}

int report_ours(lua_State* L, std::exception_ptr ours) {
    Vm& vm = Vm::of(L);
    vm.latch(std::move(ours));
    vm.raise(L, "");
}

void add_function(lua_State* L, const char* name, int (*function)(lua_State*)) {
    lua_pushcfunction(L, function);
    lua_setfield(L, -2, name);
}

}  // namespace reprise::scripting
