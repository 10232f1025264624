#include "scripting/lua/vm.h"

#include <cctype>
#include <clocale>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/charged.h"
#include "scripting/lua/hash.h"
#include "scripting/lua/text.h"
#include "world/arithmetic.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr int hook_interval = 1000;  // [VM instructions]
constexpr int deepest_calls = 5000;
constexpr std::size_t longest_message = 500;  // [bytes]

thread_local Vm* running_vm = nullptr;

/// The start of Lua's global_State, the same in all of 5.4. Lua seeds the hash of texts from the
/// clock and from addresses, and a package's build takes no seed from outside.
struct GlobalState {
    lua_Alloc allocator;
    void* self;
    std::ptrdiff_t bytes, debt;
    std::size_t estimate, last_atomic;
    TextTable texts;
    void* registry[2];
    void* nil_value[2];
    std::uint32_t seed;
};

/// Between the seed's making and its first use: lua_newstate's second request for memory. The place
/// is found by the allocator that it was just told; `seed_is_ours` tells whether it was the right
/// one. Returns the table of short texts, which lies in it.
const TextTable* set_seed(void* block, std::size_t size, lua_Alloc allocator, void* self) {
    auto* const bytes = static_cast<std::byte*>(block);
    for (std::size_t at = 0; at + sizeof(GlobalState) <= size; at += alignof(GlobalState)) {
        GlobalState state{};
        std::memcpy(&state, bytes + at, sizeof state);
        if (state.allocator != allocator || state.self != self)
            continue;
        std::memcpy(bytes + at + offsetof(GlobalState, seed), &hash_seed, sizeof hash_seed);
        return reinterpret_cast<const TextTable*>(bytes + at + offsetof(GlobalState, texts));
    }
    return nullptr;
}

/// Twelve words, in the order that Lua's own walk gives them with our seed.
bool seed_is_ours(lua_State* L) {
    constexpr const char* words = "abcdefghijkl";
    std::string order;
    lua_newtable(L);
    for (const char* word = words; *word != '\0'; ++word) {
        lua_pushlstring(L, word, 1);
        lua_pushboolean(L, 1);
        lua_rawset(L, -3);
    }
    lua_pushnil(L);
    while (lua_next(L, -2) != 0) {
        lua_pop(L, 1);
        order += lua_tostring(L, -1);
    }
    lua_pop(L, 1);
    return order == "abcdijklefgh";
}

void charge_running_vm(std::uint64_t instructions) {
    if (running_vm != nullptr)
        running_vm->charge_later(instructions);
}

/// Gives the compiler a text line by line, and so knows in which one it is.
struct SourceLines {
    std::string_view rest;
    std::uint32_t& line;
};

const char* next_line(lua_State*, void* data, std::size_t* size) {
    auto& lines = *static_cast<SourceLines*>(data);
    const std::size_t end = lines.rest.find('\n');
    *size = end == std::string_view::npos ? lines.rest.size() : end + 1;
    if (*size == 0)
        return nullptr;
    ++lines.line;
    const char* const start = lines.rest.data();
    lines.rest.remove_prefix(*size);
    return start;
}

int panic(lua_State* L) {
    const char* text = lua_tostring(L, -1);
    throw world::CheckFailed(
        fmt::format("Lua outside a protected call: {}", text == nullptr ? "no message" : text));
}

}  // namespace

class Vm::Running {
  public:
    Running(Vm& vm, lua_State* L) : vm_(vm), outer_vm_(running_vm), outer_(vm.current_) {
        running_vm = &vm;
        vm.current_ = L;
        vm.pay_ahead(L);
    }

    ~Running() {
        running_vm = outer_vm_;
        vm_.current_ = outer_;
    }

    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

  private:
    Vm& vm_;
    Vm* outer_vm_;
    lua_State* outer_;
};

Vm* Vm::running() {
    return running_vm;
}

void Vm::check_locale() {
    constexpr int a_umlaut = 0xe4;  // in Latin-1; in C and UTF-8 half a letter
    REPRISE_CHECK(std::string_view(std::localeconv()->decimal_point) == "." &&
                      std::isalpha(a_umlaut) == 0 && std::toupper(a_umlaut) == a_umlaut,
                  "a library set another locale; " + world::unusual_locale());
}

Vm::Vm(std::string script) : script_(std::move(script)) {
    main_ = lua_newstate(allocate, this);
    if (main_ == nullptr)
        throw std::bad_alloc();
    *static_cast<Vm**>(lua_getextraspace(main_)) = this;  // coroutines get a copy
    lua_atpanic(main_, panic);
    charge_library_calls(charge_running_vm);
    REPRISE_CHECK(seed_is_ours(main_), "the seed of Lua's hash is not where Lua 5.4 has it");
    REPRISE_CHECK(texts_ != nullptr && texts_->count > 0 && texts_->count < texts_->size * 4,
                  "the texts are not where Lua 5.4 has them");
    memory_.watch(*texts_);
    check_locale();
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
    const int type = block == nullptr ? static_cast<int>(old_size) : LUA_TNIL;
    if (vm.first_block_ != nullptr)
        vm.texts_ =
            set_seed(std::exchange(vm.first_block_, nullptr), vm.memory_.bytes(), allocate, self);
    void* const moved = vm.memory_.resize(block, old_size, type, new_size);
    if (vm.main_ == nullptr && vm.memory_.requests() == 1)
        vm.first_block_ = moved;
    vm.latch_refusal(vm.memory_.refusal());
    return moved;
}

/// What Lua makes of a refusal is an error that a script could catch: the latch holds.
void Vm::latch_refusal(Memory::Refusal refusal) {
    if (refusal == Memory::Refusal::none)
        return;
    const std::string where = current_ == nullptr ? script_ + ": " : position(current_);
    switch (refusal) {
        case Memory::Refusal::text:
            latch(where + "a text of more than 64 kB: print or keep it in parts");
            break;
        case Memory::Refusal::stack:
            latch(where + "calls are nested too deeply, or have too many arguments");
            break;
        case Memory::Refusal::table:
            latch(where + "a table of more than 65,536 keys that are no list");
            break;
        default:
            latch(where + "the scenario needs more than 64 MB of memory");
    }
}

/// Beyond the cap: collects what nobody holds. A script that lives so near the cap that it does
/// not help for long has too much as well.
void Vm::make_room(lua_State* L) {
    constexpr int most_collections = 3;
    constexpr std::size_t bytes_an_instruction = 32;
    if (memory_.bytes() > memory_cap && ++collections_ <= most_collections) {
        account_.take(memory_.bytes() / bytes_an_instruction);
        lua_gc(L, LUA_GCCOLLECT);
    }
    if (memory_.bytes() > memory_cap)
        latch_refusal(Memory::Refusal::cap);
}

void Vm::hook(lua_State* L, lua_Debug*) {
    Vm& vm = of(L);
    vm.make_room(L);
    vm.memory_.inspect();
    vm.charge(L, static_cast<std::uint64_t>(lua_gethookcount(L)) * vm.rate());
    if (lua_gethookcount(L) != vm.interval())
        lua_sethook(L, hook, LUA_MASKCOUNT, vm.interval());
    lua_Debug frame;
    if (lua_getstack(L, deepest_calls, &frame) != 0) {
        vm.latch(vm.position(L) + "calls are nested too deeply: an endless recursion?");
        vm.raise(L, "");
    }
}

/// What an instruction may cost with what is alive now, in plain ones.
std::uint64_t Vm::rate() const {
    constexpr std::size_t cheap_chain = 8;  // tables
    return std::max<std::uint64_t>(memory_.rate(), chain_ > cheap_chain ? 3 : 1);
}

/// Between two hooks at this rate: always about as much work.
int Vm::interval() const {
    return std::max(1, static_cast<int>(hook_interval / rate()));
}

/// Before a stack goes on. Its hook comes by what instructions cost now; as that begins to count
/// anew, what may run until then is paid now: thousands of tasks could each stay below it.
void Vm::pay_ahead(lua_State* L) {
    if (rate() == 1 && lua_gethookcount(L) == hook_interval)
        return;
    lua_sethook(L, hook, LUA_MASKCOUNT, interval());
    account_.take(hook_interval);
}

void Vm::charge(lua_State* L, std::uint64_t instructions) {
    account_.take(instructions);
    if (!is_latched() && account_.in_tick > budget_)
        latch(position(L) +
              (budget_ == budget_per_tick
                   ? "more than 10,000,000 instructions in one tick: a loop without wait()?"
                   : "more than 2,500,000 instructions before the first tick: a loop outside of "
                     "run?"));
    if (is_latched())
        raise(L, "");
}

void Vm::charge_walk(lua_State* L, std::size_t entries) {
    charge(L, entries * 8 + memory_.largest_block() / 64);
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
    for (lua_State* const stack : {L, asker_}) {
        lua_Debug frame;
        for (int level = 0; stack != nullptr && lua_getstack(stack, level, &frame) != 0; ++level) {
            lua_getinfo(stack, "Sl", &frame);
            if (frame.currentline > 0 && chunk == frame.source)
                return static_cast<std::uint32_t>(frame.currentline);
        }
    }
    return compiled_line_;
}

std::string Vm::position(lua_State* L) const {
    const std::uint32_t number = line(L);
    return number == 0 ? script_ + ": " : fmt::format("{}:{}: ", script_, number);
}

void Vm::execute(std::string_view source, const std::string& chunk, int environment) {
    const int environment_index = lua_absindex(main_, environment);
    const Running running(*this, main_);
    compiled_line_ = 0;
    SourceLines lines{source, compiled_line_};
    const int status = lua_load(main_, next_line, &lines, chunk.c_str(), "t");
    if (status != LUA_OK)
        fail(main_, status);
    compiled_line_ = 0;
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
    const Running running(*this, main_);
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

std::optional<int> Vm::resume(lua_State* coroutine, int arguments) {
    const Running running(*this, coroutine);
    int results = 0;
    const int status = lua_resume(coroutine, main_, arguments, &results);
    if (status == LUA_OK || status == LUA_YIELD)
        make_room(coroutine);
    if ((status != LUA_OK && status != LUA_YIELD) || is_latched())
        fail(coroutine, status);
    if (status == LUA_OK)
        return results;
    lua_pop(coroutine, results);
    return std::nullopt;
}

Vm::Asked Vm::ask(lua_State* coroutine, lua_State* task) {
    const Running running(*this, coroutine);
    asker_ = task;
    int results = 0;
    const int status = lua_resume(coroutine, main_, 0, &results);
    if (status == LUA_OK || status == LUA_YIELD)
        make_room(coroutine);
    if (is_latched())
        fail(coroutine, status);
    asker_ = nullptr;
    if (status == LUA_OK)
        return Asked::answered;
    if (status != LUA_YIELD)
        return Asked::failed;
    lua_pop(coroutine, results);
    return Asked::waits;
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
        throw world::Error(printable(*latched_));
    if (status == LUA_ERRMEM)
        throw world::Error(position(L) + "the scenario needs more than 64 MB of memory");
    std::string message = with_position(L, message_at_top(L));
    // A script's own error() may hold many lines; a message is one.
    if (const auto end = message.find('\n'); end != std::string::npos)
        message.erase(end);
    if (message.size() > longest_message)
        message = message.substr(0, longest_message) + " ...";
    throw world::Error(printable(message));
}

}  // namespace reprise::scripting
