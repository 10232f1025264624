// What the determinism contract costs: portable maths and a digest of every stage, against a build
// that has neither. Separate processes, in turn, because a program has one libm.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

constexpr int rounds = 9;
constexpr double ticks = 1200;

/// [s] of CPU for 1,200 ticks.
double drive(const std::string& program) {
    const auto trace = std::filesystem::temp_directory_path() / "reprise_contract_bench.mcap";
    FILE* pipe = popen((program + " " + trace.string()).c_str(), "r");
    double seconds = 0;
    if (pipe == nullptr || std::fscanf(pipe, "%lf", &seconds) != 1 || pclose(pipe) != 0)
        std::exit(1);
    std::filesystem::remove(trace);
    return seconds;
}

/// The best of all rounds: on a shared machine others only ever add.
double best(const std::vector<double>& seconds) {
    return *std::min_element(seconds.begin(), seconds.end());
}

void Contract(benchmark::State& state) {
    for (auto _ : state) {
        std::array<std::vector<double>, 3> seconds;
        for (int round = 0; round < rounds; ++round) {
            seconds[0].push_back(drive(CONTRACT_DRIVE));
            seconds[1].push_back(drive(CONTRACT_DRIVE_PLAIN));
            seconds[2].push_back(drive(CONTRACT_DRIVE_GLIBC));
        }
        const double ours = best(seconds[0]);
        const double plain = best(seconds[1]);
        const double glibc = best(seconds[2]);
        state.SetIterationTime(ours / ticks);
        state.counters["plain_us"] = plain / ticks * 1e6;
        state.counters["cost_%"] = 100 * (ours / plain - 1);
        state.counters["libm_%"] = 100 * (ours / glibc - 1);
    }
}

BENCHMARK(Contract)->UseManualTime()->Iterations(1)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
