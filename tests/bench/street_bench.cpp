// A whole tick with cars and people on foot, recorded, beside its bare parts in the same run: one
// libsumo step of the same net with the same cars, ten Bullet substeps with the bodies near the
// vehicle, and one dtCrowd update with as many agents. `of_parts`: the whole tick over their sum.
// `of_used`: over that sum and what anybody pays who makes use of libsumo's step, to tell it where
// the vehicle is (`tell_us`) and to ask it for its cars (`read_us`).
// `growth`: what a car costs more than a car among the first 50, 1 is linear.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unistd.h>
#include <utility>

#include <benchmark/benchmark.h>
#include <libsumo/libsumo.h>

#include "ground/mesh/build_ground.h"
#include "kernel/kernel.h"
#include "replay/trace_writer.h"
#include "tests/bench/bare_bullet.h"
#include "tests/bench/bare_crowd.h"
#include "tests/bench/bare_traffic.h"
#include "tests/bench/drive.h"
#include "tests/bench/timer.h"
#include "world/frames.h"

namespace {

using namespace reprise;

constexpr int warm_up = 200;  // ticks until queues have formed
constexpr int measured = 400;
constexpr double near_distance = 35;  // [m] as far as physics keeps bodies

bench::Timer* sumo_watch = nullptr;  // while a run is measured
bench::Timer* tell_watch = nullptr;

}  // namespace

// libsumo::Simulation::step(double), as the traffic room calls it.
extern "C" void __real__ZN7libsumo10Simulation4stepEd(double time);

extern "C" void __wrap__ZN7libsumo10Simulation4stepEd(double time) {
    if (sumo_watch == nullptr)
        return __real__ZN7libsumo10Simulation4stepEd(time);
    sumo_watch->time([time] { __real__ZN7libsumo10Simulation4stepEd(time); });
}

// libsumo::Vehicle::moveToXY, by which SUMO is told where the vehicle with mass is.
#define MOVE_TO_XY \
    "_ZN7libsumo7Vehicle8moveToXYERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEES8_idddid"

using MoveToXy = void(const std::string& id,
                      const std::string& edge,
                      int lane,
                      double x,
                      double y,
                      double angle,
                      int keep_route,
                      double reach);

MoveToXy real_move_to_xy __asm__("__real_" MOVE_TO_XY);
MoveToXy watched_move_to_xy __asm__("__wrap_" MOVE_TO_XY);

void watched_move_to_xy(const std::string& id,
                        const std::string& edge,
                        int lane,
                        double x,
                        double y,
                        double angle,
                        int keep_route,
                        double reach) {
    const auto tell = [&] { real_move_to_xy(id, edge, lane, x, y, angle, keep_route, reach); };
    if (tell_watch == nullptr)
        return tell();
    tell_watch->time(tell);
}

namespace {

int near_cars(const world::TickView& tick) {
    const Eigen::Vector3d ego = world::to_eigen(tick.vehicles().front().position());
    return static_cast<int>(
        std::count_if(tick.cars().begin(), tick.cars().end(), [&](const auto& car) {
            return (world::to_eigen(car.position()) - ego).norm() < near_distance;
        }));
}

/// [s] a tick; by cars and walkers.
std::map<std::pair<std::int64_t, std::int64_t>, double>& ticks_so_far() {
    static std::map<std::pair<std::int64_t, std::int64_t>, double> all;
    return all;
}

/// By the clock: where there are two processors, those on foot make their steps while traffic makes
/// its own. For a machine with nothing else to do.
void Street(benchmark::State& state) {
    world::Recording recording = bench::free_drive(static_cast<unsigned>(state.range(0)));
    recording.episode.walkers = static_cast<std::uint32_t>(state.range(1));
    recording.episode.walker_seed = 7;
    recording.episode.jaywalkers = 0.1;
    const ground::GroundMesh ground = ground::build_ground(recording.town);
    const auto path = std::filesystem::temp_directory_path() /
                      ("reprise_street_bench_" + std::to_string(getpid()) + ".mcap");
    for (auto _ : state) {
        bench::Timer whole, sumo, tell, read, bullet_alone, crowd_alone;
        replay::TraceWriter trace(path, recording);
        kernel::Kernel kernel(recording);
        std::optional<bench::BareBullet> bullet;
        std::optional<bench::BareCrowd> crowd;
        std::optional<bench::BareTraffic> traffic;
        if (state.range(1) > 0)
            crowd.emplace(recording.town, static_cast<int>(state.range(1)));
        double cars = 0;
        int near = 0;
        btVector3 place(0, 0, 0);
        for (int i = 0; i < warm_up + measured; ++i) {
            const bool counts = i >= warm_up;
            if (i == warm_up) {
                bullet.emplace(ground, near, place);
                traffic.emplace(recording.town);
                sumo_watch = &sumo;
                tell_watch = &tell;
            }
            const world::SealedTick* tick = nullptr;
            const auto step = [&] {
                tick = &kernel.step();
                trace.append(*tick);
            };
            if (!counts) {
                step();
                const world::Vec3 p = tick->view().vehicles().front().position();
                place = btVector3(p.x(), p.y(), p.z());
                near = near_cars(tick->view());
                if (crowd)
                    crowd->tick(i);
                continue;
            }
            whole.time(step);
            read.time([&] { traffic->read(); });
            bullet_alone.time([&] { bullet->tick(i); });
            if (crowd)
                crowd_alone.time([&] { crowd->tick(i); });
            cars += static_cast<double>(tick->view().cars().size()) / measured;
        }
        sumo_watch = tell_watch = nullptr;
        trace.close(kernel.outcome());
        const double tick = whole.sum() / measured;
        const double parts =
            (sumo.sum() + bullet_alone.sum() + (crowd ? crowd_alone.sum() : 0)) / measured;
        const double used = parts + (tell.sum() + read.sum()) / measured;
        ticks_so_far()[{state.range(0), state.range(1)}] = tick;
        state.SetIterationTime(tick);
        state.counters["ticks/s"] = 1 / tick;
        state.counters["real_time"] = 0.05 / tick;
        state.counters["cars"] = cars;
        state.counters["sumo_us"] = sumo.sum() / measured * 1e6;
        state.counters["bullet_us"] = bullet_alone.sum() / measured * 1e6;
        state.counters["crowd_us"] = crowd ? crowd_alone.sum() / measured * 1e6 : 0;
        state.counters["tell_us"] = tell.sum() / measured * 1e6;
        state.counters["read_us"] = read.sum() / measured * 1e6;
        state.counters["of_parts"] = tick / parts;
        state.counters["of_used"] = tick / used;
        const auto& known = ticks_so_far();
        const auto none = known.find({0, state.range(1)});
        const auto fifty = known.find({50, state.range(1)});
        if (state.range(0) > 50 && none != known.end() && fifty != known.end())
            state.counters["growth"] = (tick - none->second) / static_cast<double>(state.range(0)) /
                                       ((fifty->second - none->second) / 50);
    }
    std::filesystem::remove(path);
}

BENCHMARK(Street)
    ->ArgsProduct({{0, 10, 50, 100, 150, 200, 250}, {0, 100, 200}})
    ->ArgNames({"cars", "walkers"})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
