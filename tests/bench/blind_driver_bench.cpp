// A badly driven car beside a braked one in the same run: learning starts with blind drivers, whose
// cars stand on kerbs, in hedges and against walls. Nobody else is in town.
#include <algorithm>
#include <array>
#include <vector>

#include <benchmark/benchmark.h>

#include "kernel/kernel.h"
#include "tests/bench/drive.h"
#include "tests/bench/stopwatch.h"
#include "world/random.h"

namespace {

using namespace reprise;

constexpr int ticks = 1500;                                               // of a run
constexpr std::array<std::uint64_t, 8> seeds = {1, 2, 3, 4, 5, 6, 7, 8};  // and places to start
constexpr std::uint64_t held = 10;  // [ticks] a random control

enum Manner { straight_on, left, right, backwards, flat_out, at_random };

world::Control braked(std::uint32_t actor) {
    return {0, 1, 0, actor, 0, false, false};
}

world::Control blind(Manner manner, std::uint64_t seed, std::uint64_t tick, std::uint32_t actor) {
    const auto draw = [&](std::uint64_t item) {
        return world::draw(seed, tick / held, world::Purpose::scenario, item);
    };
    const double steer = 2 * draw(0) - 1;
    if (manner == straight_on)
        return {1, 0, 0, actor, 0, false, false};
    if (manner == left || manner == right)
        return {1, 0, manner == left ? 1.0 : -1.0, actor, 0, false, false};
    if (manner == flat_out)
        return {1, 0, steer, actor, 0, false, false};
    if (manner == backwards)
        return {1, 0, 0, actor, 0, false, true};
    return {draw(1), draw(2) < 0.2 ? draw(3) : 0, steer, actor, 0, false, draw(4) < 0.3};
}

/// Microseconds of CPU that a tick takes, mean of a run; `control` says what the car is told.
template <typename Control>
double tick_us(std::uint64_t seed, const Control& control) {
    world::Recording recording = bench::in_town1("tests/bench/empty_town.lua");
    recording.episode.seed = seed;
    kernel::Kernel kernel(recording);
    std::uint32_t actor = 0;
    while (actor == 0)
        for (const world::VehicleState& vehicle : kernel.step().view().vehicles())
            actor = vehicle.id();
    bench::Best run;
    run.time([&] {
        for (int tick = 0; tick < ticks; ++tick) {
            const world::Control said = control(static_cast<std::uint64_t>(tick), actor);
            kernel.step({&said, 1});
        }
    });
    return run.thread / ticks * 1e6;
}

void BlindDriver(benchmark::State& state, Manner manner) {
    for (auto _ : state) {
        double braked_us = 0;
        double blind_us = 0;
        double worst_us = 0;
        for (const std::uint64_t seed : seeds) {
            braked_us +=
                tick_us(seed, [](std::uint64_t, std::uint32_t actor) { return braked(actor); });
            const double us = tick_us(seed, [&](std::uint64_t tick, std::uint32_t actor) {
                return blind(manner, seed, tick, actor);
            });
            blind_us += us;
            worst_us = std::max(worst_us, us);
        }
        state.SetIterationTime(blind_us * 1e-6 / seeds.size());
        state.counters["braked_us"] = braked_us / seeds.size();
        state.counters["blind_us"] = blind_us / seeds.size();
        state.counters["worst_us"] = worst_us;
        state.counters["of_braked"] = blind_us / braked_us;
    }
}

BENCHMARK_CAPTURE(BlindDriver, straight_on, straight_on)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BlindDriver, left, left)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BlindDriver, right, right)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BlindDriver, flat_out, flat_out)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BlindDriver, backwards, backwards)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BlindDriver, at_random, at_random)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
