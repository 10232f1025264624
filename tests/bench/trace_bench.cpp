// Writing and playing a trace of 100 cars, beside a bare zstd pass over the same bytes.
#include <benchmark/benchmark.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>
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

void Write(benchmark::State& state) {
    replay::TraceReader source((drive(), trace_path()));
    std::vector<world::SealedTick> sealed;
    for (std::uint64_t index = 1; index <= source.ticks(); ++index) {
        const auto tick = source.tick(index);
        world::TickDraft draft;
        tick.view.tick->UnPackTo(&draft.tick);
        tick.view.traffic->UnPackTo(&draft.traffic);
        sealed.push_back(world::seal(draft, draft.tick.digests.chain()));
    }
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

BENCHMARK(BareZstdCompress)->Unit(benchmark::kMillisecond);
BENCHMARK(Write)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(BareZstdDecompress)->Unit(benchmark::kMillisecond);
BENCHMARK(Play)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
