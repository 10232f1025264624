// Encoding, writing, playing and verifying a trace of 100 cars and 100 walkers, each beside a bare
// zstd pass over the same bytes, in turn.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <zlib.h>
#include <zstd.h>

#include "kernel/kernel.h"
#include "kernel/verify.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "tests/bench/recorded_drive.h"
#include "tests/bench/stopwatch.h"

namespace {

using namespace reprise;
using namespace bench;

constexpr int rounds = 5;  // ours, bare, ours, bare, ...: the machine's mood hits both

void bare_compress() {
    std::string out;
    for (const std::string& chunk : drive().chunks) {
        out.resize(ZSTD_compressBound(chunk.size()));
        benchmark::DoNotOptimize(
            ZSTD_compress(out.data(), out.size(), chunk.data(), chunk.size(), 1));
    }
}

void bare_decompress() {
    std::string out;
    for (std::size_t i = 0; i < drive().packed.size(); ++i) {
        const std::string& packed = drive().packed[i];
        out.resize(drive().chunks[i].size());
        benchmark::DoNotOptimize(
            ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size()));
    }
}

/// What is said of a piece of work and its bare part. Their ratio is of time of CPU, of all
/// threads: what others do on the machine does not count.
void report(benchmark::State& state, const Best& ours, const Best& bare) {
    state.SetIterationTime(ours.wall / static_cast<double>(ticks));
    state.counters["cpu_us"] = us(ours.cpu);
    state.counters["bare_cpu_us"] = us(bare.cpu);
    state.counters["of_bare"] = ours.cpu / bare.cpu;
}

/// Both in turn, each by its best round.
template <typename Ours, typename Bare>
void beside(benchmark::State& state, const Ours& ours, const Bare& bare) {
    drive();
    for (auto _ : state) {
        Best best;
        Best best_bare;
        for (int round = 0; round < rounds; ++round) {
            best.time(ours);
            best_bare.time(bare);
        }
        report(state, best, best_bare);
    }
}

/// The drive's ticks as the stages leave them.
std::vector<world::TickDraft> drafts() {
    replay::TraceReader source((drive(), trace_path()));
    std::vector<world::TickDraft> all(source.ticks());
    for (std::uint64_t index = 1; index <= source.ticks(); ++index) {
        const auto tick = source.tick(index);
        tick.view.tick->UnPackTo(&all[index - 1].tick);
        tick.view.traffic->UnPackTo(&all[index - 1].traffic);
    }
    return all;
}

/// The drive's ticks as the kernel hands them over.
std::vector<world::SealedTick> sealed_ticks() {
    std::vector<world::SealedTick> sealed;
    for (world::TickDraft& draft : drafts())
        sealed.push_back(world::seal(draft, draft.tick.digests.chain()));
    return sealed;
}

/// From a tick's draft to its bytes, digest chain and all.
void Encode(benchmark::State& state) {
    std::vector<world::TickDraft> all = drafts();
    beside(
        state,
        [&] {
            for (world::TickDraft& draft : all)
                benchmark::DoNotOptimize(world::seal(draft, draft.tick.digests.chain()));
        },
        bare_compress);
}

/// From the bytes to a whole file, back to back: with nothing to do between two ticks.
void Write(benchmark::State& state) {
    const std::vector<world::SealedTick> sealed = sealed_ticks();
    const auto path = temporary("_write");
    beside(
        state,
        [&] {
            replay::TraceWriter trace(path, drive().recording);
            for (const world::SealedTick& tick : sealed)
                trace.append(tick);
            trace.close({"completed", "", ticks});
        },
        bare_compress);
    std::filesystem::remove(path);
}

void Play(benchmark::State& state) {
    beside(state, play, bare_decompress);
}

/// Simulates the recorded ticks again, comparing each. The kernel's making is left out.
void Verify(benchmark::State& state) {
    drive();
    for (auto _ : state) {
        Best best;
        Best best_bare;
        for (int round = 0; round < rounds; ++round) {
            replay::TraceReader trace(trace_path());
            kernel::Kernel kernel(trace.recording());
            best.time([&] {
                if (kernel::follow(kernel, trace, ticks))
                    std::abort();
            });
            best_bare.time(bare_decompress);
        }
        report(state, best, best_bare);
    }
}

/// Opens a trace of REPRISE_BENCH_GB gigabytes (made on first use; default: a quarter) and reads a
/// tick anywhere in it.
std::filesystem::path big_trace(double gigabytes) {
    const auto path = temporary("_" + std::to_string(gigabytes) + "GB");
    if (std::filesystem::exists(path))
        return path;
    const std::vector<world::SealedTick> sealed = sealed_ticks();
    replay::TraceWriter trace(path, drive().recording);
    const auto partial = path.string() + ".partial";
    std::uint64_t index = 0;
    while (index % 6400 != 0 || index == 0 ||
           static_cast<double>(std::filesystem::file_size(partial)) < gigabytes * 1e9) {
        world::TickDraft draft;
        const world::TickView view = sealed[index % sealed.size()].view();
        view.tick->UnPackTo(&draft.tick);
        view.traffic->UnPackTo(&draft.traffic);
        draft.tick.index = draft.traffic.tick = ++index;
        trace.append(world::seal(draft, draft.tick.digests.chain()));
    }
    trace.close({"completed", "", index});
    return path;
}

double big_size() {
    const char* wanted = std::getenv("REPRISE_BENCH_GB");
    return wanted == nullptr ? 0.25 : std::atof(wanted);
}

void OpenBigAndReadAnyTick(benchmark::State& state) {
    const auto path = big_trace(big_size());
    std::uint64_t seed = 1;
    for (auto _ : state) {
        replay::TraceReader trace(path);
        seed = seed * 6364136223846793005U + 1442695040888963407U;
        benchmark::DoNotOptimize(trace.tick(1 + (seed >> 32) % trace.ticks()).view.index());
    }
    state.counters["GB"] = static_cast<double>(std::filesystem::file_size(path)) / 1e9;
}

void bare_crc() {
    for (const std::string& chunk : drive().chunks)
        benchmark::DoNotOptimize(crc32(0,
                                       reinterpret_cast<const unsigned char*>(chunk.data()),
                                       static_cast<unsigned>(chunk.size())));
}

/// Every checksum of the file, and every tick, beside bare checksums.
void ReadAndCheckAll(benchmark::State& state) {
    beside(
        state,
        [] {
            replay::TraceReader trace(trace_path());
            for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
                benchmark::DoNotOptimize(trace.tick(index).view.index());
            benchmark::DoNotOptimize(trace.damage().has_value());
        },
        bare_crc);
}

void once(benchmark::internal::Benchmark* bench) {
    bench->UseManualTime()->Iterations(1)->Unit(benchmark::kMicrosecond);
}

BENCHMARK(Encode)->Apply(once);
BENCHMARK(Write)->Apply(once);
BENCHMARK(Play)->Apply(once);
BENCHMARK(Verify)->Apply(once);
BENCHMARK(ReadAndCheckAll)->Apply(once);
BENCHMARK(OpenBigAndReadAnyTick)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
