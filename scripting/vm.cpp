#include "scripting/vm.h"

#include <cstdlib>
#include <fmt/format.h>
#include <new>

#include <lua.hpp>

#include "scripting/text.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr int hook_interval = 1000;        // [VM instructions]
constexpr int deepest_calls = 5000;        // Lua's own limit lies beyond the memory cap
constexpr std::size_t long_string = 1024;  // [bytes] from here on a string costs by its length
constexpr std::uint64_t bytes_per_charge = 8;

int panic(lua_State* L) {
    const char* text = lua_tostring(L, -1);
    throw world::CheckFailed(
        fmt::format("Lua outside a protected call: {}", text == nullptr ? "no message" : text));
}

}  // namespace

Vm::Vm(std::string script) : script_(std::move(script)) {
    main_ = lua_newstate(allocate, this);
    if (main_ == nullptr)
        throw std::bad_alloc();
    *static_cast<Vm**>(lua_getextraspace(main_)) = this;  // coroutines get a copy
    lua_atpanic(main_, panic);
    lua_sethook(main_, hook, LUA_MASKCOUNT, hook_interval);
}

Vm::~Vm() {
    lua_close(main_);
}

Vm& Vm::of(lua_State* L) {
    return **static_cast<Vm**>(lua_getextraspace(L));
}

void* Vm::allocate(void* self, void* block, std::size_t old_size, std::size_t new_size) {
    Vm& vm = *static_cast<Vm*>(self);
    // For a new block Lua passes its type in the place of the old size.
    const std::size_t held = block == nullptr ? 0 : old_size;
    if (new_size == 0) {
        std::free(block);
        vm.bytes_ -= held;
        return nullptr;
    }
    if (new_size > held && vm.bytes_ - held + new_size > memory_cap)
        return nullptr;
    void* moved = std::realloc(block, new_size);
    if (moved == nullptr)
        return nullptr;
    vm.bytes_ += new_size - held;
    if (block == nullptr && old_size == LUA_TSTRING && new_size >= long_string)
        vm.spend(new_size / bytes_per_charge);
    return moved;
}

void Vm::hook(lua_State* L, lua_Debug*) {
    Vm& vm = of(L);
    vm.charge(L, hook_interval);
    lua_Debug frame;
    if (lua_getstack(L, deepest_calls, &frame) != 0) {
        vm.latch(vm.position(L) + "calls are nested too deeply: an endless recursion?");
        vm.raise(L, "");
    }
}

void Vm::spend(std::uint64_t instructions) {
    spent_ += instructions;
    spent_in_tick_ += instructions;
}

void Vm::charge(lua_State* L, std::uint64_t instructions) {
    spend(instructions);
    if (!is_latched() && spent_in_tick_ > budget_per_tick)
        latch(position(L) +
              "more than 10,000,000 instructions in one tick: a loop without wait()?");
    if (is_latched())
        raise(L, "");
}

void Vm::latch(std::string reason) {
    if (!latched_)
        latched_ = std::move(reason);
}

void Vm::latch(std::exception_ptr ours) {
    if (!ours_)
        ours_ = std::move(ours);
    latch(std::string("internal error"));
}

void Vm::raise(lua_State* L, const std::string& message) {
    const std::string& text = latched_ ? *latched_ : message;
    lua_pushlstring(L, text.data(), text.size());
    lua_error(L);
    std::abort();  // lua_error does not return, which its declaration does not say
}

std::uint32_t Vm::line(lua_State* L) const {
    const std::string chunk = "@" + script_;
    lua_Debug frame;
    for (int level = 0; lua_getstack(L, level, &frame) != 0; ++level) {
        lua_getinfo(L, "Sl", &frame);
        if (frame.currentline > 0 && chunk == frame.source)
            return static_cast<std::uint32_t>(frame.currentline);
    }
    return 0;
}

std::string Vm::position(lua_State* L) const {
    const std::uint32_t number = line(L);
    return number == 0 ? script_ + ": " : fmt::format("{}:{}: ", script_, number);
}

void Vm::execute(std::string_view source, const std::string& chunk, int environment) {
    const int environment_index = lua_absindex(main_, environment);
    const int status = luaL_loadbufferx(main_, source.data(), source.size(), chunk.c_str(), "t");
    if (status != LUA_OK)
        fail(main_, status);
    lua_pushvalue(main_, environment_index);
    lua_setupvalue(main_, -2, 1);
    call(0, 1);
}

/// Message handler: runs where the error was raised, while the stack still shows the line.
int Vm::add_position(lua_State* L) {
    const Vm& vm = of(L);
    const std::string text = vm.with_position(L, vm.message_at_top(L));
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

int Vm::call_protected(int arguments, int results) {
    const int function = lua_gettop(main_) - arguments;
    lua_pushcfunction(main_, add_position);
    lua_insert(main_, function);
    const int status = lua_pcall(main_, arguments, results, function);
    lua_remove(main_, function);
    return status;
}

void Vm::call(int arguments, int results) {
    const int status = call_protected(arguments, results);
    if (status != LUA_OK || is_latched())
        fail(main_, status);
}

bool Vm::ask() {
    in_check = true;
    not_ready = false;
    const int status = call_protected(0, 1);
    in_check = false;
    if (is_latched() || (status != LUA_OK && !not_ready))
        fail(main_, status);
    if (not_ready)
        lua_pop(main_, 1);
    return !not_ready;
}

bool Vm::resume(lua_State* coroutine, int arguments) {
    int results = 0;
    const int status = lua_resume(coroutine, main_, arguments, &results);
    if ((status != LUA_OK && status != LUA_YIELD) || is_latched())
        fail(coroutine, status);
    lua_pop(coroutine, results);
    return status == LUA_YIELD;
}

std::string Vm::message_at_top(lua_State* L) const {
    if (lua_type(L, -1) == LUA_TSTRING || lua_type(L, -1) == LUA_TNUMBER)
        return text_of(L, -1);
    return fmt::format("error with a {} instead of a message", luaL_typename(L, -1));
}

/// Messages that start with a place in the script keep it; all others get the innermost line.
std::string Vm::with_position(lua_State* L, const std::string& message) const {
    if (message.rfind(script_ + ":", 0) == 0)
        return message;
    std::string text = message;
    if (text.rfind("prelude:", 0) == 0)
        text.erase(0, text.find(": ") + 2);
    return position(L) + text;
}

void Vm::fail(lua_State* L, int status) {
    if (ours_)
        std::rethrow_exception(ours_);
    if (latched_)
        throw world::Error(*latched_);
    if (status == LUA_ERRMEM)
        throw world::Error(script_ + ": the scenario needs more than 64 MB of memory");
    std::string message = with_position(L, message_at_top(L));
    // A script's own error() may hold many lines; a message is one.
    if (const auto end = message.find('\n'); end != std::string::npos)
        message.erase(end);
    throw world::Error(message);
}

}  // namespace reprise::scripting
