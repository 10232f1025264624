// What recording adds to a simulation among 100 cars and 100 walkers, and how much faster its
// recording is played back.
#include <optional>

#include "tests/bench/recorded_drive.h"
#include "tests/bench/stopwatch.h"

namespace {

using namespace reprise;
using namespace bench;

constexpr int rounds = 10;

/// All ticks; recorded, when there is a path, into a whole file.
void simulate(kernel::Kernel& kernel, const std::filesystem::path& path) {
    std::optional<replay::TraceWriter> trace;
    if (!path.empty())
        trace.emplace(path, drive().recording);
    for (std::uint64_t i = 0; i < ticks; ++i) {
        const world::SealedTick& tick = kernel.step();
        if (trace)
            trace->append(tick);
    }
    if (trace)
        trace->close(kernel.outcome());
}

/// The simulation recorded, not recorded, and played back, in turn. What recording adds, as a share
/// of the recorded tick: of all time of CPU (`cpu_%`: the thread that compresses counts), of the
/// simulation's own thread (`thread_%`), and by the clock on the wall, which needs an idle machine.
void Recording(benchmark::State& state) {
    const auto path = temporary("_run");
    drive();
    for (auto _ : state) {
        Best recorded;
        Best bare;
        Best played;
        for (int round = 0; round < rounds; ++round) {
            {
                kernel::Kernel kernel(drive().recording);
                recorded.time([&] { simulate(kernel, path); });
            }
            {
                kernel::Kernel kernel(drive().recording);
                bare.time([&] { simulate(kernel, {}); });
            }
            played.time(play);
        }
        const auto share = [](double with, double without) { return 100 * (1 - without / with); };
        state.SetIterationTime(recorded.wall / static_cast<double>(ticks));
        state.counters["cpu_us"] = us(recorded.cpu);
        state.counters["not_recorded_us"] = us(bare.cpu);
        state.counters["cpu_%"] = share(recorded.cpu, bare.cpu);
        state.counters["thread_%"] = share(recorded.thread, bare.thread);
        state.counters["wall_%"] = share(recorded.wall, bare.wall);
        state.counters["played_us"] = us(played.cpu);
        state.counters["play_faster"] = bare.cpu / played.cpu;
    }
    std::filesystem::remove(path);
}

BENCHMARK(Recording)->UseManualTime()->Iterations(1)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
