// A whole tick, recorded, beside its bare parts in the same run: one bare libsumo step with the same
// cars, and ten bare Bullet substeps with the same bodies.
#include <benchmark/benchmark.h>
#include <libsumo/libsumo.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "kernel/kernel.h"
#include "replay/trace_writer.h"
#include "tests/bench/bare_bullet.h"
#include "tests/bench/drive.h"
#include "traffic/background.h"
#include "world/frames.h"

namespace {

using namespace reprise;
using Clock = std::chrono::steady_clock;

constexpr int warm_up = 200;  // ticks until queues have formed
constexpr int measured = 400;
constexpr double near_distance = 60;  // [m] as far as physics keeps bodies

double seconds(Clock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

struct Measured {
    double tick = 0;    // [s] mean
    double record = 0;  // [s] mean, of the simulation thread
    double near = 0;    // cars near the vehicle, mean
    double bytes = 0;   // a tick, before compression
    world::Vec3 place{};
};

int near_cars(const world::TickView& tick) {
    const Eigen::Vector3d ego = world::to_eigen(tick.vehicles().front().position());
    int count = 0;
    for (const world::CarState& car : tick.cars())
        count += (world::to_eigen(car.position()) - ego).norm() < near_distance;
    return count;
}

Measured whole_tick(const replay::Recording& recording, const std::filesystem::path& path) {
    replay::TraceWriter trace(path, recording);
    kernel::Kernel kernel(recording);
    for (int i = 0; i < warm_up; ++i)
        trace.append(kernel.step());
    Measured mean;
    for (int i = 0; i < measured; ++i) {
        const auto begin = Clock::now();
        const world::SealedTick& tick = kernel.step();
        const auto stepped = Clock::now();
        trace.append(tick);
        const auto end = Clock::now();
        mean.tick += seconds(end - begin) / measured;
        mean.record += seconds(end - stepped) / measured;
        mean.near += static_cast<double>(near_cars(tick.view())) / measured;
        mean.bytes +=
            static_cast<double>(tick.tick_bytes().size() + tick.traffic_bytes().size()) / measured;
        mean.place = tick.view().vehicles().front().position();
    }
    trace.close(kernel.outcome());
    return mean;
}

struct BareSumo {
    double step = 0;  // [s] mean
    double cars = 0;  // mean; without Reprise nobody refills the town, so it may sink a little
};

/// The same cars in the same town over the same ticks, stepped by libsumo alone.
BareSumo bare_sumo(const replay::Recording& recording) {
    traffic::Background background(recording.episode, recording.town, recording.network);
    world::TickDraft genesis;
    world::SealedTick last = world::seal(genesis, {});
    for (int i = 1; i <= warm_up; ++i) {
        world::TickDraft next;
        next.tick.index = static_cast<std::uint64_t>(i);
        background.advance(last.view(), next);
        last = world::seal(next, {});
    }
    BareSumo mean;
    for (int i = 0; i < measured; ++i) {
        const auto begin = Clock::now();
        libsumo::Simulation::step();
        mean.step += seconds(Clock::now() - begin) / measured;
        mean.cars += static_cast<double>(libsumo::Vehicle::getIDCount()) / measured;
    }
    return mean;
}

double bare_bullet(const replay::Recording& recording, const Measured& whole) {
    bench::BareBullet bullet(world::build_ground(recording.town),
                             static_cast<int>(std::lround(whole.near)),
                             {whole.place.x(), whole.place.y(), whole.place.z()});
    for (int i = 0; i < warm_up; ++i)
        bullet.tick(i);
    const auto begin = Clock::now();
    for (int i = 0; i < measured; ++i)
        bullet.tick(warm_up + i);
    return seconds(Clock::now() - begin) / measured;
}

void Tick(benchmark::State& state) {
    const replay::Recording recording = bench::free_drive(static_cast<unsigned>(state.range(0)));
    const auto path = std::filesystem::temp_directory_path() / "reprise_tick_bench.mcap";
    for (auto _ : state) {
        const Measured whole = whole_tick(recording, path);
        const BareSumo sumo = bare_sumo(recording);
        const double bullet = bare_bullet(recording, whole);
        state.SetIterationTime(whole.tick);
        state.counters["ticks/s"] = 1 / whole.tick;
        state.counters["tick_us"] = whole.tick * 1e6;
        state.counters["bare_sumo_us"] = sumo.step * 1e6;
        state.counters["bare_cars"] = sumo.cars;
        state.counters["bare_bullet_us"] = bullet * 1e6;
        state.counters["of_bare"] = whole.tick / (sumo.step + bullet);
        state.counters["record_us"] = whole.record * 1e6;
        state.counters["record_%"] = 100 * whole.record / whole.tick;
        state.counters["near"] = whole.near;
        state.counters["raw_B"] = whole.bytes;
        state.counters["file_B"] =
            static_cast<double>(std::filesystem::file_size(path)) / (warm_up + measured);
    }
    std::filesystem::remove(path);
}

BENCHMARK(Tick)->Arg(0)->Arg(10)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->UseManualTime()->Iterations(
    1)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
