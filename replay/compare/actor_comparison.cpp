#include "replay/compare/actor_comparison.h"

#include <algorithm>

#include <fmt/format.h>

namespace reprise::replay {

namespace {

/// What of a tick's list belongs to the actor.
template <typename State, typename IdOf>
std::vector<State> those_of(std::span<const State> states, std::uint32_t actor, IdOf id_of) {
    std::vector<State> kept;
    std::copy_if(states.begin(), states.end(), std::back_inserter(kept), [&](const State& state) {
        return id_of(state) == actor;
    });
    return kept;
}

world::SealedTick of_actor(const world::TickView& tick, std::uint32_t actor) {
    const auto by_id = [](const auto& state) { return state.id(); };
    const auto by_actor = [](const auto& state) { return state.actor(); };
    world::TickDraft draft;
    draft.tick.index = draft.traffic.tick = tick.index();
    draft.tick.controls = those_of(tick.controls(), actor, by_actor);
    draft.tick.vehicles = those_of(tick.vehicles(), actor, by_id);
    draft.tick.wheels =
        those_of(tick.wheels(), actor, [](const auto& wheel) { return wheel.vehicle(); });
    draft.tick.measurements = those_of(tick.measurements(), actor, by_actor);
    draft.tick.looks = those_of(tick.vehicle_looks(), actor, by_actor);
    draft.tick.props = those_of(tick.props(), actor, by_id);
    draft.tick.doors = those_of(tick.doors(), actor, by_actor);
    if (tick.tick->commands() != nullptr)
        for (const world::Command* command : *tick.tick->commands())
            if (command->actor() == actor)
                command->UnPackTo(&draft.tick.commands.emplace_back());
    if (tick.tick->events() != nullptr)
        for (const world::Event* event : *tick.tick->events())
            if (event->actor() == actor || event->other() == actor)
                event->UnPackTo(&draft.tick.events.emplace_back());
    if (tick.traffic != nullptr) {
        draft.traffic.cars = those_of(tick.cars(), actor, by_id);
        draft.traffic.walkers = those_of(tick.walkers(), actor, by_id);
        draft.traffic.looks = those_of(tick.car_looks(), actor, by_actor);
    }
    return world::seal(draft, {});
}

bool is_in(const world::TickView& tick, std::uint32_t actor) {
    return world::find(tick.vehicles(), actor) != nullptr ||
           world::find(tick.props(), actor) != nullptr ||
           (tick.traffic != nullptr && (world::find(tick.cars(), actor) != nullptr ||
                                        world::find(tick.walkers(), actor) != nullptr));
}

/// Where one run goes on, and the actor in it.
std::optional<Divergence> compare_actor_ends(TraceReader& expected,
                                             TraceReader& found,
                                             std::uint32_t actor) {
    const std::uint64_t common = std::min(expected.ticks(), found.ticks());
    TraceReader& longer = expected.ticks() > common ? expected : found;
    if (longer.ticks() == common || !is_in(longer.recorded(common + 1).view, actor))
        return std::nullopt;
    Divergence divergence;
    divergence.tick = common + 1;
    divergence.stage = "end";
    divergence.actor = fmt::format("actor {}", actor);
    divergence.actor_id = actor;
    divergence.field = "ticks";
    divergence.expected = std::to_string(expected.ticks());
    divergence.found = std::to_string(found.ticks());
    divergence.note = "what both have of it is equal";
    return divergence;
}

}  // namespace

ActorTick::ActorTick(const RecordedTick& tick, std::uint32_t actor)
    : sealed_(of_actor(tick.view, actor)),
      has_traffic_(tick.view.traffic != nullptr) {}

RecordedTick ActorTick::view() const {
    RecordedTick tick{sealed_.view(), sealed_.tick_bytes(), sealed_.traffic_bytes()};
    if (!has_traffic_) {
        tick.view.traffic = nullptr;
        tick.traffic_bytes = {};
    }
    return tick;
}

std::optional<Divergence> compare(TraceReader& expected,
                                  TraceReader& found,
                                  std::uint32_t actor,
                                  Tolerance* tolerance) {
    // Nobody differs before anything does.
    const std::optional<Divergence> anybody = compare(expected, found);
    const std::uint64_t common = std::min(expected.ticks(), found.ticks());
    if (!anybody || (anybody->stage == "start" && anybody->tick == 0))
        return std::nullopt;
    std::optional<Divergence> divergence;
    for (std::uint64_t index = std::max<std::uint64_t>(1, anybody->tick);
         index <= common && !divergence;
         ++index)
        divergence = compare_recorded(ActorTick(expected.recorded(index), actor).view(),
                                      ActorTick(found.recorded(index), actor).view(),
                                      tolerance);
    if (!divergence)
        divergence = compare_actor_ends(expected, found, actor);
    if (divergence)
        add_context(*divergence, expected.ticks() < divergence->tick ? found : expected);
    return divergence;
}

}  // namespace reprise::replay
