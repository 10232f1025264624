#include "scripting/words/vocabulary.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/text.h"
#include "scripting/run/caps.h"
#include "scripting/run/run.h"

namespace reprise::scripting {

namespace {

// What is printed is recorded, outside of Lua's memory.
constexpr std::uint64_t line_cost = 200;  // [instructions]
constexpr std::uint64_t byte_cost = 10;   // [instructions]

/// Into the trace, never to the terminal: the program that runs the scenario shows it.
int print(Run& run, lua_State* L) {
    std::string text;
    for (int index = 1; index <= lua_gettop(L); ++index) {
        text += (index == 1 ? "" : " ") + text_of(L, index);
        if (text.size() > longest_text)
            refuse("print", "more than 64 kB in one call");
    }
    run.vm.charge(L, line_cost + byte_cost * text.size());
    run.printed_in_tick += text.size();
    run.printed += text.size();
    if (run.printed_in_tick > most_printed)
        refuse("print", "more than 256 kB in one tick");
    if (run.printed > most_printed_in_run)
        refuse("print", "more than 256 MB in one run");
    // One event a line; what it says is shown, and does nothing to the terminal that shows it.
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        run.vm.charge(L, line_cost);
        if (run.next->tick.events.size() >= most_events)
            refuse("print", fmt::format("more than {} lines in one tick", most_events));
        world::EventT event;
        event.kind = world::EventKind::printed;
        event.text = printable(std::string_view(text).substr(start, end - start));
        event.line = run.vm.line(L);
        run.next->tick.events.push_back(std::move(event));
        start = end + 1;
    }
    return 0;
}

std::string stream_at(const Run& run, lua_State* L, int index, const char* who) {
    std::string name = lua_isnoneornil(L, index) ? "" : name_at(L, index, who, "the stream's name");
    if (run.streams.size() >= most_streams && !run.streams.has(name))
        refuse(who, fmt::format("more than {} streams", most_streams));
    return name;
}

int random(Run& run, lua_State* L) {
    lua_pushnumber(L, run.streams.draw(stream_at(run, L, 1, "random")));
    return 1;
}

int random_int(Run& run, lua_State* L) {
    const std::int64_t low = integer_at(L, 1, "random_int", "the lowest");
    const std::int64_t high = integer_at(L, 2, "random_int", "the highest");
    constexpr std::int64_t widest = std::int64_t{1} << 53U;  // exact in the drawn double
    if (high < low || static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) >= widest)
        refuse("random_int", fmt::format("no numbers to choose from in [{}, {}]", low, high));
    lua_pushinteger(L, run.streams.draw_integer(stream_at(run, L, 3, "random_int"), low, high));
    return 1;
}

constexpr Word other_rows[] = {
    {"print", bound<print>, "(...)", "into the trace, a line an event"},
    {"random",
     acting<random>,
     "(stream?: string): number",
     "a number in [0, 1), by the run's seed"},
    {"random_int",
     acting<random_int>,
     "(low: integer, high: integer, stream?: string): integer",
     "a whole number in [low, high], by the run's seed"},
};

}  // namespace

constinit const WordList other_words{Owner::global, "Chance, print", other_rows};

void add_vocabulary(lua_State* L) {
    add_header_words(L);
    add_task_words(L);
    add_check_words(L);
    add_handle_words(L);
    add_meeting_words(L);
    add_spawn_words(L);
    add_place_words(L);
    add_environment_words(L);
    add_words(L, road_words);
    add_words(L, other_words);
}

}  // namespace reprise::scripting
