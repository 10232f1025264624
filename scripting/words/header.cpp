#include "scripting/words/header.h"

#include <string_view>

#include <lua.hpp>

#include "scripting/lua/sandbox.h"
#include "scripting/lua/source.h"
#include "scripting/lua/vm.h"
#include "scripting/words/vocabulary.h"
#include "world/check.h"

namespace reprise::scripting {

Header read_header(Vm& vm, const std::string& source) {
    lua_State* L = vm.main();
    Header header;
    vm.header = &header;
    push_sandbox(L);  // vocabulary, environment
    lua_pushvalue(L, -2);
    add_vocabulary(L);
    lua_pop(L, 1);
    vm.execute(prelude_source, "=prelude", -2);
    lua_pop(L, 1);

    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    std::string_view text = source;
    if (text.substr(0, byte_order_mark.size()) == byte_order_mark)
        text.remove_prefix(byte_order_mark.size());
    check_source(text, vm.script());
    vm.execute(text, "@" + vm.script(), -1);
    const bool returned = lua_type(L, -1) == LUA_TTABLE && header.run != 0;
    lua_settop(L, 0);
    vm.header = nullptr;
    if (!returned)
        throw world::Error(vm.script() +
                           ": a scenario file ends with: return scenario 'name' { ... }");
    return header;
}

}  // namespace reprise::scripting
