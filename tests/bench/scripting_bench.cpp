// What a scenario's tasks and checks add to a tick, measured beside the tick itself: while a kernel
// runs a scenario, the script plays a second time on the very same ticks, and the same script
// without its tasks and checks a third time. All three see the same world, so the difference of the
// last two is what watching costs.
#include <benchmark/benchmark.h>

#include "kernel/kernel.h"
#include "scripting/scenario.h"
#include "tests/bench/drive.h"
#include "tests/bench/timer.h"

namespace {

using namespace reprise;

constexpr int warm_up = 200;  // ticks until queues have formed
constexpr int measured = 1000;

/// A script that plays along and is not heard.
class Listener {
  public:
    Listener(const world::Recording& recording, const world::LaneMap& lanes)
        : scenario_(recording.episode, recording.town, lanes) {}

    void advance(const world::TickView& last) {
        world::TickDraft unheard;
        unheard.tick.index = last.index() + 1;
        time.time([&] { scenario_.advance(last, unheard); });
    }

    bench::ThreadTimer time;

  private:
    scripting::Scenario scenario_;
};

world::SealedTick genesis() {
    world::TickDraft draft;
    return world::seal(draft, {});
}

void Scripting(benchmark::State& state) {
    const world::Recording recording = bench::in_town1("tests/bench/scripted.lua");
    world::Recording silent = recording;
    for (world::ParameterT& parameter : silent.episode.parameters)
        parameter.value.assign(1, '0');  // GCC 12 warns of a literal here
    const world::LaneMap lanes(recording.town);
    for (auto _ : state) {
        kernel::Kernel kernel(recording);
        Listener with(recording, lanes);
        Listener without(silent, lanes);
        const world::SealedTick nothing = genesis();
        world::TickView last = nothing.view();
        bench::ThreadTimer step;
        for (int i = 0; i < warm_up + measured; ++i) {
            if (i == warm_up) {
                step = {};
                with.time = without.time = {};
            }
            // In turns, so that neither always finds the caches as the other left them.
            if (i % 2 == 0)
                with.advance(last);
            without.advance(last);
            if (i % 2 == 1)
                with.advance(last);
            step.time([&] { last = kernel.step().view(); });
        }
        const double added = with.time.median() - without.time.median();
        state.SetIterationTime(step.median());
        state.counters["script_us"] = with.time.median() * 1e6;
        state.counters["without_us"] = without.time.median() * 1e6;
        state.counters["added_us"] = added * 1e6;
        state.counters["added_%"] = 100 * added / (step.median() - added);
        state.counters["added_by_sums_%"] = 100 * (with.time.sum() - without.time.sum()) /
                                            (step.sum() - with.time.sum() + without.time.sum());
    }
}

BENCHMARK(Scripting)->UseManualTime()->Iterations(1)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
