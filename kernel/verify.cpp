#include "kernel/verify.h"

#include <algorithm>

#include "kernel/kernel.h"
#include "world/check.h"
#include "world/digest.h"

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
    for (std::uint64_t index = 1; index <= last; ++index) {
        const auto damage = recorded.damage(index);
        const auto expected = damage ? recorded.salvaged(index) : recorded.recorded(index);
        if (!expected)
            return unreadable(index, *damage);
        if (kernel.finished())
            return ended_early(index, kernel);
        const world::SealedTick& found = kernel.step(expected->view.controls());
        if (auto divergence = replay::compare(*expected, as_recorded(found))) {
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
    Kernel kernel(recorded.recording());
    if (auto divergence = follow(kernel, recorded, recorded.ticks(), on_tick))
        return divergence;
    // Every tick agrees, but the file may still be damaged where no tick lies.
    if (const auto damage = recorded.damage())
        return unreadable(0, *damage);
    return std::nullopt;
}

}  // namespace reprise::kernel
