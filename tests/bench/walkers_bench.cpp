// A tick of the people on foot, beside a bare dtCrowd with as many agents on the same mesh.
#include <benchmark/benchmark.h>

#include "tests/bench/bare_crowd.h"
#include "tests/bench/drive.h"
#include "tests/bench/timer.h"
#include "walkers/crowd.h"

namespace {

using namespace reprise;

constexpr int warm_up = 200;  // ticks
constexpr int measured = 1000;

void Walkers(benchmark::State& state) {
    world::Recording recording = bench::free_drive(0);
    recording.episode.walkers = static_cast<std::uint32_t>(state.range(0));
    recording.episode.walker_seed = 7;
    recording.episode.jaywalkers = 0.1;
    const world::LaneMap lanes(recording.town);
    for (auto _ : state) {
        bench::Timer making;
        bench::Timer ours;
        bench::Timer bare;
        walkers::WalkingGround ground(recording.town);
        making.time([&] {
            ground.pavement();
            ground.streets();
        });
        walkers::Crowd crowd(recording.episode, recording.town, lanes, ground);
        bench::BareCrowd agents(recording.town, static_cast<int>(state.range(0)));
        world::TickDraft genesis;
        world::SealedTick last = world::seal(genesis, {});
        for (int i = 1; i <= warm_up + measured; ++i) {
            walkers::OnFoot on_foot{static_cast<std::uint64_t>(i), {}, {}};
            if (i <= warm_up) {
                crowd.advance(last.view(), on_foot);
                agents.tick(i);
            } else {
                ours.time([&] { crowd.advance(last.view(), on_foot); });
                bare.time([&] { agents.tick(i); });
            }
            world::TickDraft next;
            next.tick.index = on_foot.tick;
            next.tick.signals.assign(
                recording.town.signals.size(),
                i / 200 % 2 == 0 ? world::SignalColor::green : world::SignalColor::red);
            next.tick.events = std::move(on_foot.events);
            next.traffic.walkers = std::move(on_foot.walkers);
            last = world::seal(next, {});
        }
        state.SetIterationTime(ours.median());
        state.counters["bare_dtcrowd_us"] = bare.median() * 1e6;
        state.counters["of_bare"] = ours.sum() / bare.sum();
        state.counters["map_ms"] = making.sum() * 1e3;
    }
}

BENCHMARK(Walkers)->Arg(100)->Arg(200)->UseManualTime()->Iterations(1)->Unit(
    benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
