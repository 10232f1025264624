#include "kernel/verify.h"

#include <algorithm>

#include <fmt/format.h>

#include "kernel/kernel.h"
#include "replay/chain_seed.h"
#include "replay/level.h"
#include "replay/outcomes.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/external/external_drivers.h"

namespace reprise::kernel {

namespace {

replay::RecordedTick as_recorded(const world::SealedTick& tick) {
    return {tick.view(), tick.tick_bytes(), tick.traffic_bytes()};
}

replay::Divergence unreadable(std::uint64_t tick, const std::string& damage) {
    replay::Divergence divergence;
    divergence.tick = tick;
    divergence.stage = "encoding";
    divergence.field = "the file's bytes";
    divergence.expected = "damaged";
    divergence.found = "simulated again without trouble";
    divergence.note = damage;
    return divergence;
}

/// Somebody put another network into the trace.
std::optional<replay::Divergence> wrong_network(const world::Recording& recording) {
    const world::Digest128& wanted = recording.episode.town_digest;
    const world::Digest128 found = world::digest128(recording.network);
    const bool unknown = wanted == world::Digest128();  // a recording made without
    if (unknown || found == wanted)
        return std::nullopt;
    replay::Divergence divergence;
    divergence.stage = "start";
    divergence.field = "town_digest";
    divergence.expected = world::to_hex(wanted);
    divergence.found = world::to_hex(found);
    divergence.note = "the network in the trace is not the one that was driven on";
    return divergence;
}

/// Somebody changed what the run started from.
std::optional<replay::Divergence> wrong_start(replay::TraceReader& recorded) {
    const world::Digest128 wanted = replay::chain_seed(recorded.recording());
    const world::Digest128 found = recorded.chain(0);
    if (found == wanted)
        return std::nullopt;
    replay::Divergence divergence;
    divergence.stage = "start";
    divergence.field = "chain_seed";
    divergence.expected = world::to_hex(found);
    divergence.found = world::to_hex(wanted);
    divergence.note =
        "the episode, the town or the network in the trace is not what the run started from";
    return divergence;
}

/// A branch behind the end of a run: it decides nothing, so no tick can tell whether it is true.
std::optional<replay::Divergence> idle_branch(const replay::TraceReader& recorded,
                                              const Kernel& kernel) {
    const auto& branches = recorded.episode().branches;
    if (!kernel.finished() || branches.empty() || branches.back().tick < recorded.last())
        return std::nullopt;
    replay::Divergence divergence;
    divergence.stage = "start";
    divergence.field = "branches";
    divergence.expected = fmt::format("a branch at tick {}", branches.back().tick);
    divergence.found = fmt::format("the run ends at tick {}", recorded.last());
    return divergence;
}

/// Behind the last tick: whether the run ends there, and so. Of a part of a run, of one that was
/// cut off, and of one whose driver was lost, only that it goes on: nobody makes another verdict of
/// a run by taking the last one away.
std::optional<replay::Divergence> compare_end(const replay::TraceReader& recorded,
                                              const Kernel& kernel,
                                              const world::ExternalDrivers& drivers) {
    const world::Outcome& expected = recorded.outcome();
    const std::uint64_t ticks = recorded.ticks();
    const bool is_cut_off = expected == world::outcome_of_cut_off(ticks);
    const bool goes_on = expected == world::outcome_of_part(ticks) || is_cut_off ||
                         (expected.ticks == ticks && drivers.explain(expected));
    replay::Divergence divergence;
    divergence.tick = ticks;
    divergence.stage = "end";
    divergence.field = "outcome";
    divergence.expected = replay::to_text(expected);
    divergence.found = kernel.finished() ? replay::to_text(kernel.outcome()) : "the run goes on";
    if (kernel.finished() ? kernel.outcome() == expected : goes_on)
        return idle_branch(recorded, kernel);
    divergence.note = "all ticks are equal";
    if (is_cut_off)
        divergence.note +=
            "; nothing but how it ended was cut off: `reprise run` of the trace makes "
            "that, too";
    return divergence;
}

replay::Divergence ended_early(std::uint64_t tick, const Kernel& kernel) {
    replay::Divergence divergence;
    divergence.tick = tick;
    divergence.stage = "scenario";
    divergence.field = "end";
    divergence.expected = "the run goes on";
    divergence.found = "ended: " + kernel.outcome().reason;
    return divergence;
}

/// Goes on behind a difference that shows only in a digest.
void find_first_recorded(replay::Divergence& divergence,
                         replay::TraceReader& recorded,
                         Kernel& kernel) {
    const std::uint64_t last = std::min(recorded.ticks(), divergence.tick + replay::longest_search);
    std::optional<replay::Divergence> first;
    std::uint64_t index = divergence.tick;
    try {
        while (!first && index < last && !kernel.finished() && !recorded.damage(index + 1)) {
            const replay::RecordedTick expected = recorded.recorded(++index);
            const world::SealedTick& found = kernel.step(expected.view.controls());
            first = replay::compare_recorded(expected, as_recorded(found));
        }
    } catch (const world::Error&) {
        // A run that went astray may fail where the recorded one did not: then this is all we know.
    }
    replay::add_first_recorded(divergence, first, index - divergence.tick);
}

}  // namespace

std::optional<replay::Divergence> follow(
    Kernel& kernel,
    replay::TraceReader& recorded,
    std::uint64_t last,
    const std::function<void(const world::SealedTick&)>& on_tick) {
    replay::Reduction reduction(recorded.level());
    for (std::uint64_t index = 1; index <= last; ++index) {
        const auto damage = recorded.damage(index);
        const auto expected = damage ? recorded.salvaged(index) : recorded.recorded(index);
        if (!expected)
            return unreadable(index, *damage);
        if (kernel.finished())
            return ended_early(index, kernel);
        const world::SealedTick& found = kernel.step(expected->view.controls());
        // Reduced as when it was recorded: what the level leaves out may not be there either.
        if (auto divergence = replay::compare(*expected, reduction.of(as_recorded(found)))) {
            if (divergence->unrecorded)
                find_first_recorded(*divergence, recorded, kernel);
            if (damage)
                divergence->note += (divergence->note.empty() ? "" : "; ") + *damage;
            replay::add_context(*divergence, recorded);
            return divergence;
        }
        if (on_tick)
            on_tick(found);
    }
    return std::nullopt;
}

std::optional<replay::Divergence> verify(
    replay::TraceReader& recorded, const std::function<void(const world::SealedTick&)>& on_tick) {
    if (auto divergence = wrong_network(recorded.recording()))
        return divergence;
    if (auto divergence = wrong_start(recorded))
        return divergence;
    Kernel kernel(recorded.recording());
    world::ExternalDrivers drivers;
    const auto see = [&](const world::SealedTick& tick) {
        drivers.hear(*tick.view().tick);
        if (on_tick)
            on_tick(tick);
    };
    if (auto divergence = follow(kernel, recorded, recorded.ticks(), see))
        return divergence;
    // Every tick agrees, but there are bytes where no tick lies.
    if (const auto damage = recorded.damage())
        return unreadable(0, *damage);
    return compare_end(recorded, kernel, drivers);
}

}  // namespace reprise::kernel
