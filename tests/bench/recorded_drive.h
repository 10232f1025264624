#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <zstd.h>

#include "kernel/kernel.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "tests/bench/drive.h"

namespace reprise::bench {

inline constexpr std::uint64_t ticks = 1200;
inline constexpr std::uint64_t chunk_ticks = 64;

inline std::filesystem::path temporary(const std::string& name) {
    return std::filesystem::temp_directory_path() / ("reprise_bench" + name + ".mcap");
}

inline std::filesystem::path trace_path() {
    return temporary("");
}

/// One minute in the crowd, recorded once for all benchmarks here; and its bytes, in chunks.
struct Drive {
    world::Recording recording = crowd();
    std::vector<std::string> chunks;
    std::vector<std::string> packed;

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
        for (const std::string& chunk : chunks) {
            std::string out(ZSTD_compressBound(chunk.size()), '\0');
            out.resize(ZSTD_compress(out.data(), out.size(), chunk.data(), chunk.size(), 1));
            packed.push_back(out);
        }
    }
};

inline const Drive& drive() {
    static const Drive once;
    return once;
}

/// [us] a tick.
inline double us(double seconds) {
    return seconds * 1e6 / static_cast<double>(ticks);
}

/// Reads every tick, as `render` and `cat` do, checksums and all.
inline void play() {
    replay::TraceReader trace(trace_path());
    double sum = 0;
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
        for (const world::CarState& car : trace.tick(index).view.cars())
            sum += car.position().x();
    benchmark::DoNotOptimize(sum);
}

}  // namespace reprise::bench
