#include "scripting/scenario.h"

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/literals.h"
#include "scripting/lua/sandbox.h"
#include "scripting/run/run.h"
#include "scripting/words/header.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/weather/weather_text.h"

namespace reprise::scripting {

namespace {

constexpr int parameters_at = 1;  // on the main stack

/// Pushes the parameter's value.
void push_value(lua_State* L, const std::string& script, const world::ParameterT& parameter) {
    const auto value = parse_literal(parameter.value);
    if (!value)
        throw world::Error(fmt::format(
            "{}: parameter '{}' is no literal: {}", script, parameter.key, parameter.value));
    push(L, *value);
}

/// Pushes the parameters of this run, which know no others.
void push_parameters(lua_State* L, const world::EpisodeT& episode) {
    lua_newtable(L);
    for (const auto& parameter : episode.parameters) {
        push_value(L, episode.scenario_path, parameter);
        lua_setfield(L, -2, parameter.key.c_str());
    }
    refuse_unknown(L, "params");
}

void add(world::Hasher& hasher, const std::vector<world::ParameterT>& parameters) {
    for (const world::ParameterT& parameter : parameters) {
        hasher.add_text(parameter.key);
        hasher.add_text(parameter.value);
    }
}

}  // namespace

struct Scenario::Machine {
    Machine(const world::EpisodeT& episode, const world::TownT& town, const world::LaneMap& lanes)
        : vm(episode.scenario_path),
          run(vm, episode, town, lanes) {}

    /// Reads the episode's script; its run function begins in the next step.
    void start() {
        const Header header = read_header(vm, run.episode.scenario);
        vm.run = &run;
        plan_weather(header);
        lua_State* L = vm.main();
        push_parameters(L, run.episode);  // stays at `parameters_at`
        lua_rawgeti(L, LUA_REGISTRYINDEX, header.run);
        lua_pushvalue(L, parameters_at);
        run.tasks.start(L, 1);
    }

    /// What the command line said instead of the header lies in the episode: another weather has no
    /// timeline, and a friction of its own holds as the header's does.
    void plan_weather(const Header& header) {
        const world::EpisodeT& episode = run.episode;
        const bool as_written = episode.weather == header.weather.weather;
        const auto other = world::weather_of_text(episode.weather_name);
        const double expected = header.friction        ? *header.friction
                                : as_written || !other ? header.weather.friction
                                                       : other->road_friction;
        const bool own_friction = episode.road_friction != expected && !vm.in_branch;
        run.weathers.plan(as_written ? header.timeline : std::vector<WeatherEntry>(),
                          own_friction ? episode.road_friction : header.friction);
    }

    Vm vm;
    Run run;
    std::vector<world::CheckResult> decided;  ///< of scripts whose place this one took
    std::uint64_t taken_over = 0;             ///< digest of what branches changed; 0: nothing
};

Scenario::Scenario(const world::EpisodeT& episode,
                   const world::TownT& town,
                   const world::LaneMap& lanes)
    : machine_(std::make_unique<Machine>(episode, town, lanes)) {
    machine_->start();
}

Scenario::~Scenario() = default;

void Scenario::take_over() {
    const world::EpisodeT& episode = machine_->run.episode;
    const world::TownT& town = machine_->run.town;
    const world::LaneMap& lanes = machine_->run.lanes;
    using world::CheckResult;
    std::vector<CheckResult> decided = checks();
    std::erase_if(decided, [](const CheckResult& check) {
        return check.status == CheckResult::Status::not_evaluated;
    });
    Actors actors = std::move(machine_->run.actors);
    Streams streams = std::move(machine_->run.streams);
    world::Hasher scripts;
    scripts.add(machine_->taken_over);
    scripts.add_text(episode.scenario);
    add(scripts, episode.parameters);
    machine_.reset();  // the new machine lies at the same addresses
    machine_ = std::make_unique<Machine>(episode, town, lanes);
    machine_->vm.in_branch = true;
    machine_->start();
    machine_->run.actors = std::move(actors);
    machine_->run.streams = std::move(streams);
    machine_->decided = std::move(decided);
    machine_->taken_over = scripts.digest64();
}

void Scenario::change(const std::vector<world::ParameterT>& parameters) {
    lua_State* L = machine_->vm.main();
    for (const world::ParameterT& parameter : parameters) {
        lua_pushlstring(L, parameter.key.data(), parameter.key.size());
        push_value(L, machine_->vm.script(), parameter);
        lua_rawset(L, parameters_at);  // whatever the script made of the table
    }
    world::Hasher changes;
    changes.add(machine_->taken_over);
    add(changes, parameters);
    machine_->taken_over = changes.digest64();
}

void Scenario::advance(const world::TickView& last, world::TickDraft& next) {
    Run& run = machine_->run;
    if (run.finished)
        return;
    Vm::check_locale();
    run.last = last;
    run.speak_into(&next);
    run.vm.refill();
    run.observe();
    run.weathers.advance(last, next, run.episode.step_ns);
    run.tasks.advance(run, last.index());
    run.checks.evaluate(run);
    run.speak_into(nullptr);
}

void Scenario::conclude(const world::TickView&, world::TickDraft& next) {
    // The last tick counts too: the checks see it as it will be recorded.
    world::TickDraft copy = next;
    const world::SealedTick final_tick = world::seal(copy, {});
    Run& run = machine_->run;
    run.last = final_tick.view();
    run.speak_into(&next);  // from what is left of the tick's account: it is the same tick
    run.observe();
    run.finished = true;
    run.checks.conclude(run);
    run.speak_into(nullptr);
}

std::uint64_t Scenario::digest() const {
    const Run& run = machine_->run;
    world::Hasher hasher;
    hasher.add(run.vm.instructions());
    hasher.add(static_cast<std::uint64_t>(run.vm.memory().bytes()));
    hasher.add(run.vm.memory().requests());
    hasher.add(static_cast<std::uint8_t>(run.finished));
    run.actors.digest(hasher);
    run.tasks.digest(hasher);
    run.checks.digest(hasher);
    run.streams.digest(hasher);
    run.weathers.digest(hasher);
    if (machine_->taken_over != 0)
        hasher.add(machine_->taken_over);
    return hasher.digest64();
}

std::vector<world::CheckResult> Scenario::checks() const {
    std::vector<world::CheckResult> all = machine_->decided;
    const std::vector<world::CheckResult> own = machine_->run.checks.results();
    all.insert(all.end(), own.begin(), own.end());
    return all;
}

}  // namespace reprise::scripting
