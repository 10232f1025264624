#include "scripting/run/step_context.h"

#include <fmt/format.h>

#include "scripting/run/caps.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr std::uint64_t command_cost = 1000;  // [instructions]: at most 10,000 in a tick

}  // namespace

world::CommandT& StepContext::say(lua_State* L, world::CommandKind kind, std::uint32_t actor) {
    REPRISE_CHECK(next != nullptr, "a command outside of a step");
    if (next->tick.commands.size() >= most_commands)
        throw world::Error(fmt::format("more than {} commands in one tick", most_commands));
    vm.charge(L, command_cost);
    world::CommandT& command = next->tick.commands.emplace_back();
    command.kind = kind;
    command.actor = actor;
    command.lane = world::none;
    command.line = vm.line(L);
    return command;
}

void StepContext::finish(const std::string& reason, std::uint32_t line) {
    finished = true;
    world::CommandT& command = next->tick.commands.emplace_back();
    command.kind = world::CommandKind::finish;
    command.lane = world::none;
    command.text = reason;
    command.line = line;
}

}  // namespace reprise::scripting
