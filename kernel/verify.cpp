#include "kernel/verify.h"

#include "kernel/kernel.h"

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

}  // namespace

std::optional<replay::Divergence> verify(replay::TraceReader& recorded,
                                         const std::function<void(std::uint64_t)>& on_tick) {
    Kernel kernel(recorded.recording());
    for (std::uint64_t index = 1; index <= recorded.ticks(); ++index) {
        const auto damage = recorded.damage(index);
        const auto expected = damage ? recorded.salvaged(index) : recorded.tick(index);
        if (!expected)
            return unreadable(index, *damage);
        if (kernel.finished()) {
            replay::Divergence divergence;
            divergence.tick = index;
            divergence.stage = "scenario";
            divergence.field = "end";
            divergence.expected = "the run goes on";
            divergence.found = "ended: " + kernel.outcome().reason;
            return divergence;
        }
        const auto controls = expected->view.controls();
        const world::SealedTick& found = kernel.step(controls);
        if (auto divergence = replay::compare(*expected, as_recorded(found))) {
            if (damage)
                divergence->note += (divergence->note.empty() ? "" : "; ") + *damage;
            replay::name_actor(*divergence, recorded);
            return divergence;
        }
        if (on_tick)
            on_tick(index);
    }
    // Every tick agrees, but the file may still be damaged where no tick lies.
    if (const auto damage = recorded.damage())
        return unreadable(0, *damage);
    return std::nullopt;
}

}  // namespace reprise::kernel
