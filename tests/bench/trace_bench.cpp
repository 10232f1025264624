// Writing and playing a trace of 100 cars, beside a bare zstd pass over the same bytes.
#include <benchmark/benchmark.h>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>
#include <zlib.h>
#include <zstd.h>

#include "kernel/kernel.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "tests/bench/drive.h"

namespace {

using namespace reprise;

constexpr std::uint64_t ticks = 1200;
constexpr std::uint64_t chunk_ticks = 64;

std::filesystem::path trace_path() {
    return std::filesystem::temp_directory_path() / "reprise_trace_bench.mcap";
}

/// One minute among 100 cars, recorded once for all benchmarks here; and its bytes, in chunks.
struct Drive {
    replay::Recording recording = bench::free_drive(100);
    std::vector<std::string> chunks;

    Drive() {
        replay::TraceWriter trace(trace_path(), recording);
        kernel::Kernel kernel(recording);
        for (std::uint64_t i = 0; i < ticks; ++i) {
            const world::SealedTick& tick = kernel.step();
            trace.append(tick);
            if (i % chunk_ticks == 0)
                chunks.emplace_back();
            for (const auto bytes : {tick.tick_bytes(), tick.traffic_bytes()})
                chunks.back().append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        }
        trace.close(kernel.outcome());
    }
};

const Drive& drive() {
    static const Drive once;
    return once;
}

void per_tick(benchmark::State& state) {
    state.counters["ticks/s"] = benchmark::Counter(static_cast<double>(ticks),
                                                   benchmark::Counter::kIsIterationInvariantRate);
}

void BareZstdCompress(benchmark::State& state) {
    drive();
    std::string out;
    for (auto _ : state)
        for (const std::string& chunk : drive().chunks) {
            out.resize(ZSTD_compressBound(chunk.size()));
            benchmark::DoNotOptimize(
                ZSTD_compress(out.data(), out.size(), chunk.data(), chunk.size(), 1));
        }
    per_tick(state);
}

void BareZstdDecompress(benchmark::State& state) {
    std::vector<std::string> packed;
    for (const std::string& chunk : drive().chunks) {
        std::string out(ZSTD_compressBound(chunk.size()), '\0');
        out.resize(ZSTD_compress(out.data(), out.size(), chunk.data(), chunk.size(), 1));
        packed.push_back(out);
    }
    std::string out;
    for (auto _ : state)
        for (std::size_t i = 0; i < packed.size(); ++i) {
            out.resize(drive().chunks[i].size());
            benchmark::DoNotOptimize(
                ZSTD_decompress(out.data(), out.size(), packed[i].data(), packed[i].size()));
        }
    per_tick(state);
}

void Play(benchmark::State& state) {
    drive();
    for (auto _ : state) {
        replay::TraceReader trace(trace_path());
        double sum = 0;
        for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
            for (const world::CarState& car : trace.tick(index).view.cars())
                sum += car.position().x();
        benchmark::DoNotOptimize(sum);
    }
    per_tick(state);
}

/// The drive's ticks as the kernel hands them over.
std::vector<world::SealedTick> sealed_ticks() {
    replay::TraceReader source((drive(), trace_path()));
    std::vector<world::SealedTick> sealed;
    for (std::uint64_t index = 1; index <= source.ticks(); ++index) {
        const auto tick = source.tick(index);
        world::TickDraft draft;
        tick.view.tick->UnPackTo(&draft.tick);
        tick.view.traffic->UnPackTo(&draft.traffic);
        sealed.push_back(world::seal(draft, draft.tick.digests.chain()));
    }
    return sealed;
}

void Write(benchmark::State& state) {
    const std::vector<world::SealedTick> sealed = sealed_ticks();
    const auto path = std::filesystem::temp_directory_path() / "reprise_trace_bench_write.mcap";
    for (auto _ : state) {
        replay::TraceWriter trace(path, drive().recording);
        for (const world::SealedTick& tick : sealed)
            trace.append(tick);
        trace.close({"completed", "", ticks});
    }
    std::filesystem::remove(path);
    per_tick(state);
}

/// Opens a trace of REPRISE_BENCH_GB gigabytes (made on first use; default: a quarter) and reads a
/// tick anywhere in it.
std::filesystem::path big_trace(double gigabytes) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("reprise_trace_bench_" + std::to_string(gigabytes) + "GB.mcap");
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

void BareCrc(benchmark::State& state) {
    for (auto _ : state)
        for (const std::string& chunk : drive().chunks)
            benchmark::DoNotOptimize(crc32(0,
                                           reinterpret_cast<const unsigned char*>(chunk.data()),
                                           static_cast<unsigned>(chunk.size())));
    per_tick(state);
}

/// Every checksum of the file, and every tick.
void ReadAndCheckAll(benchmark::State& state) {
    drive();
    for (auto _ : state) {
        replay::TraceReader trace(trace_path());
        for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
            benchmark::DoNotOptimize(trace.tick(index).view.index());
        benchmark::DoNotOptimize(trace.damage().has_value());
    }
    per_tick(state);
}

/// The simulation itself, recorded and not: what recording costs, and how much faster playing is.
void Simulate(benchmark::State& state) {
    const bool recorded = state.range(0) != 0;
    const auto path = std::filesystem::temp_directory_path() / "reprise_trace_bench_run.mcap";
    for (auto _ : state) {
        kernel::Kernel kernel(drive().recording);
        std::optional<replay::TraceWriter> trace;
        if (recorded)
            trace.emplace(path, drive().recording);
        for (std::uint64_t i = 0; i < ticks; ++i) {
            const world::SealedTick& tick = kernel.step();
            if (trace)
                trace->append(tick);
        }
        if (trace)
            trace->close(kernel.outcome());
    }
    per_tick(state);
}

BENCHMARK(Simulate)
    ->ArgName("recorded")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(BareCrc)->Unit(benchmark::kMillisecond);
BENCHMARK(ReadAndCheckAll)->Unit(benchmark::kMillisecond);
BENCHMARK(OpenBigAndReadAnyTick)->Unit(benchmark::kMillisecond);
BENCHMARK(BareZstdCompress)->Unit(benchmark::kMillisecond);
BENCHMARK(Write)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(BareZstdDecompress)->Unit(benchmark::kMillisecond);
BENCHMARK(Play)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
