// A whole tick, recorded, beside its bare parts in the same run: one bare libsumo step with the
// same cars, and ten bare Bullet substeps with the same bodies.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <benchmark/benchmark.h>
#include <libsumo/libsumo.h>

#include "ground/mesh/build_ground.h"
#include "kernel/kernel.h"
#include "replay/trace_writer.h"
#include "tests/bench/bare_bullet.h"
#include "tests/bench/drive.h"
#include "tests/bench/timer.h"
#include "traffic/background.h"
#include "world/frames.h"

namespace {

using namespace reprise;

constexpr int rounds = 3;     // whole, bare, whole, bare, ...: the machine's mood hits both
constexpr int warm_up = 200;  // ticks until queues have formed
constexpr int measured = 400;
constexpr double near_distance = 35;  // [m] as far as physics keeps bodies

using bench::Timer;
Timer* sumo_watch = nullptr;  // while a run is measured

}  // namespace

// libsumo::Simulation::step(double), as the traffic room calls it.
extern "C" void __real__ZN7libsumo10Simulation4stepEd(double time);

extern "C" void __wrap__ZN7libsumo10Simulation4stepEd(double time) {
    if (sumo_watch == nullptr)
        return __real__ZN7libsumo10Simulation4stepEd(time);
    sumo_watch->time([time] { __real__ZN7libsumo10Simulation4stepEd(time); });
}

namespace {

struct Run {
    Timer step;
    Timer record;  // of the simulation thread
    Timer bare_sumo;
    Timer bare_bullet;
    Timer sumo_alone;
    double near = 0;       // cars near the vehicle, mean
    double bytes = 0;      // a tick, before compression, mean
    double bare_cars = 0;  // mean; without Reprise nobody refills the town
    world::Vec3 place{};
};

int near_cars(const world::TickView& tick) {
    const Eigen::Vector3d ego = world::to_eigen(tick.vehicles().front().position());
    int count = 0;
    for (const world::CarState& car : tick.cars())
        count += (world::to_eigen(car.position()) - ego).norm() < near_distance;
    return count;
}

void whole_tick(const world::Recording& recording,
                const ground::GroundMesh& ground,
                const std::filesystem::path& path,
                Run& run) {
    replay::TraceWriter trace(path, recording);
    kernel::Kernel kernel(recording);
    for (int i = 0; i < warm_up; ++i) {
        const world::SealedTick& tick = kernel.step();
        trace.append(tick);
        run.near = near_cars(tick.view());
        run.place = tick.view().vehicles().front().position();
    }
    bench::BareBullet bullet(ground,
                             static_cast<int>(std::lround(run.near)),
                             {run.place.x(), run.place.y(), run.place.z()});
    run.bytes = 0;
    sumo_watch = &run.bare_sumo;
    for (int i = 0; i < measured; ++i) {
        const world::SealedTick* tick = nullptr;
        run.step.time([&] { tick = &kernel.step(); });
        run.record.time([&] { trace.append(*tick); });
        run.bare_bullet.time([&] { bullet.tick(i); });
        run.bytes += static_cast<double>(tick->tick_bytes().size() + tick->traffic_bytes().size()) /
                     measured;
    }
    sumo_watch = nullptr;
    trace.close(kernel.outcome());
}

/// The same cars in the same town over the same ticks, stepped by libsumo alone.
void sumo_alone(const world::Recording& recording, Run& run) {
    const world::LaneMap lanes(recording.town);
    traffic::Background background(recording.episode, recording.town, lanes, recording.network);
    world::TickDraft genesis;
    world::SealedTick last = world::seal(genesis, {});
    for (int i = 1; i <= warm_up; ++i) {
        world::TickDraft next;
        next.tick.index = static_cast<std::uint64_t>(i);
        background.advance(last.view(), next, traffic::Background::in_turn);
        last = world::seal(next, {});
    }
    run.bare_cars = 0;
    for (int i = 0; i < measured; ++i) {
        run.sumo_alone.time([] { libsumo::Simulation::step(); });
        run.bare_cars += static_cast<double>(libsumo::Vehicle::getIDCount()) / measured;
    }
}

void Tick(benchmark::State& state) {
    const world::Recording recording = bench::free_drive(static_cast<unsigned>(state.range(0)));
    const ground::GroundMesh ground = ground::build_ground(recording.town);
    const auto path = std::filesystem::temp_directory_path() / "reprise_tick_bench.mcap";
    for (auto _ : state) {
        Run run;
        for (int round = 0; round < rounds; ++round) {
            whole_tick(recording, ground, path, run);
            sumo_alone(recording, run);
        }
        const double tick = run.step.median() + run.record.median();
        const double bare = run.bare_sumo.median() + run.bare_bullet.median();
        const double ratio =
            (run.step.sum() + run.record.sum()) / (run.bare_sumo.sum() + run.bare_bullet.sum());
        state.SetIterationTime(tick);
        state.counters["ticks/s"] = 1 / tick;
        state.counters["sumo_us"] = run.bare_sumo.median() * 1e6;
        state.counters["bullet_us"] = run.bare_bullet.median() * 1e6;
        state.counters["of_bare_medians"] = tick / bare;
        state.counters["of_bare"] = ratio;
        state.counters["sumo_alone_us"] = run.sumo_alone.median() * 1e6;
        state.counters["record_us"] = run.record.median() * 1e6;
        state.counters["record_%"] = 100 * run.record.median() / tick;
        state.counters["near"] = run.near;
        state.counters["bare_cars"] = run.bare_cars;
        state.counters["raw_B"] = run.bytes;
        state.counters["file_B"] =
            static_cast<double>(std::filesystem::file_size(path)) / (warm_up + measured);
    }
    std::filesystem::remove(path);
}

BENCHMARK(Tick)
    ->Arg(0)
    ->Arg(10)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
