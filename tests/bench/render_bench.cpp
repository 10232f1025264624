// Pictures of Town 1 with 100 cars and 50 walkers on one core, as the file that is written, beside
// bare Embree: all the rays of the same picture on the same scenes, with nothing in between. LiDAR
// sweeps likewise. Then
// what a second thread makes of many pictures, beside what it makes of the bare rays. Figures are
// medians of turns.
#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "kernel/kernel.h"
#include "render/picture.h"
#include "render/sensors.h"
#include "tests/bench/drive.h"
#include "tests/bench/timer.h"
#include "tests/bench/traced_rays.h"
#include "world/check.h"
#include "world/weather/weather.h"

namespace {

using namespace reprise;
using world::SensorKind;

constexpr int turns = 7;

constexpr int seen_ticks = 8;

/// The town and the ticks that are seen, one after the other and again: each look places everybody
/// anew, as in a film.
struct Scene {
    world::Recording recording = [] {
        world::Recording made = bench::free_drive(100);
        made.episode.walkers = 50;
        return made;
    }();
    kernel::Kernel kernel{recording};
    std::vector<std::vector<std::uint8_t>> ticks;
    std::vector<std::vector<std::uint8_t>> traffic;

    Scene() {
        for (int i = 0; i < 300; ++i) {
            const world::SealedTick& tick = kernel.step();
            if (i < 300 - seen_ticks)
                continue;
            ticks.emplace_back(tick.tick_bytes().begin(), tick.tick_bytes().end());
            traffic.emplace_back(tick.traffic_bytes().begin(), tick.traffic_bytes().end());
        }
    }

    world::TickView at(std::size_t index) const {
        return {world::GetTick(ticks[index].data()), world::GetTraffic(traffic[index].data())};
    }

    world::TickView first() const { return at(0); }

    world::TickView next() const {
        static std::atomic<unsigned> looks = 0;
        return at(looks++ % seen_ticks);
    }
};

const Scene& scene() {
    static const Scene once;
    return once;
}

/// A file that is gone when this is.
struct ScratchFile {
    std::filesystem::path path = std::filesystem::temp_directory_path() /
                                 fmt::format("reprise-render-bench-{}.png", getpid());

    ~ScratchFile() { std::filesystem::remove(path); }
};

struct Picture {
    std::vector<SensorKind> kinds;
    int width;
    int height;
    const char* weather = "clear_noon";
};

world::SensorRig rig_of(const Picture& picture) {
    world::SensorRig rig;
    for (const SensorKind kind : picture.kinds) {
        world::SensorSpec sensor;
        sensor.name = std::to_string(rig.size());
        sensor.kind = kind;
        sensor.width = picture.width;
        sensor.height = picture.height;
        sensor.actor = scene().first().vehicles().front().id();
        rig.push_back(sensor);
    }
    return rig;
}

std::vector<world::SensorFrame> observe(render::Sensors& sensors, const Picture& picture) {
    return sensors.observe(
        scene().next(), rig_of(picture), world::find_weather(picture.weather)->weather);
}

/// Median CPU time of looks. [ms]
double time_frames(render::Sensors& sensors, const Picture& picture) {
    bench::ThreadTimer frames;
    observe(sensors, picture);
    for (int turn = 0; turn < turns; ++turn)
        frames.time([&] { benchmark::DoNotOptimize(observe(sensors, picture)); });
    return 1e3 * frames.median();
}

void look(benchmark::State& state, const Picture& picture) {
    bench::ThreadTimer frames, files, bare;
    std::size_t rays = 0;
    {
        render::Sensors sensors(scene().recording.town, {.threads = 1});
        const ScratchFile file;
        observe(sensors, picture);
        const auto packets = bench::traced_packets([&] { observe(sensors, picture); });
        rays = bench::rays_of(packets);
        REPRISE_CHECK(rays > 0, "no ray came by");
        for (int turn = 0; turn < turns; ++turn) {
            std::vector<world::SensorFrame> seen;
            frames.time([&] { seen = observe(sensors, picture); });
            files.time([&] {
                for (const world::SensorFrame& frame : seen)
                    render::write_png(frame, file.path);
            });
            bare.time([&] { bench::trace_again(packets); });
        }
    }
    render::Sensors portable(scene().recording.town, {.threads = 1, .portable = true});
    const double ms = 1e3 * (frames.median() + files.median());
    for (auto _ : state)
        state.SetIterationTime(ms / 1e3);
    state.counters["frame_ms"] = 1e3 * frames.median();
    state.counters["png_ms"] = 1e3 * files.median();
    state.counters["bare_ms"] = 1e3 * bare.median();
    state.counters["of_bare"] = ms / 1e3 / bare.median();
    state.counters["frames/s"] = 1 / frames.median();
    state.counters["portable_ms"] = time_frames(portable, picture);
    state.counters["Mrays"] = 1e-6 * static_cast<double>(rays);
}

/// What a picture by night takes, with its file, beside the same one at noon: in turns.
void Night(benchmark::State& state) {
    const Picture noon{{SensorKind::rgb}, 800, 600};
    const Picture night{{SensorKind::rgb}, 800, 600, "clear_night"};
    render::Sensors sensors(scene().recording.town, {.threads = 1});
    const ScratchFile file;
    const auto make = [&](const Picture& picture) {
        render::write_png(observe(sensors, picture).front(), file.path);
    };
    make(noon);
    make(night);
    bench::ThreadTimer by_day, by_night;
    for (int turn = 0; turn < turns; ++turn) {
        by_day.time([&] { make(noon); });
        by_night.time([&] { make(night); });
    }
    for (auto _ : state)
        state.SetIterationTime(by_night.median());
    state.counters["of_noon"] = by_night.median() / by_day.median();
}

/// A whole turn of 64 lasers, 2048 shots each, on the roof of the first vehicle.
world::SensorRig roof_lidar(SensorKind kind) {
    world::SensorSpec sensor;
    sensor.name = "roof";
    sensor.kind = kind;
    sensor.actor = scene().first().vehicles().front().id();
    sensor.position = {1.2, 0, 1.8};
    sensor.attributes = {{"channels", 64},
                         {"range", 100},
                         {"rotation_frequency", 1 / sensor.step},
                         {"points_per_second", 64 * 2048 / sensor.step}};
    return {sensor};
}

void sweep(benchmark::State& state, SensorKind kind, const char* weather) {
    const world::SensorRig rig = roof_lidar(kind);
    const world::Weather& air = world::find_weather(weather)->weather;
    render::Sensors sensors(scene().recording.town, {.threads = 1});
    const auto observe = [&] {
        benchmark::DoNotOptimize(sensors.observe(scene().next(), rig, air));
    };
    observe();
    const auto packets = bench::traced_packets(observe);
    REPRISE_CHECK(bench::rays_of(packets) > 0, "no ray came by");
    bench::ThreadTimer sweeps, bare;
    for (int turn = 0; turn < turns; ++turn) {
        sweeps.time(observe);
        bare.time([&] { bench::trace_again(packets); });
    }
    for (auto _ : state)
        state.SetIterationTime(sweeps.median());
    state.counters["bare_ms"] = 1e3 * bare.median();
    state.counters["of_bare"] = sweeps.median() / bare.median();
    state.counters["Mrays"] = 1e-6 * static_cast<double>(bench::rays_of(packets));
}

/// The town as a program finds it, until the first picture is there: a small one, with the shapes
/// of all who are at that tick, who are made when they are first met.
void StartUp(benchmark::State& state) {
    const world::TownT& town = scene().recording.town;
    for (auto _ : state) {
        bench::ThreadTimer timer;
        timer.time([&] {
            render::Sensors sensors(town, {.threads = 1});
            benchmark::DoNotOptimize(observe(sensors, {{SensorKind::semantic}, 84, 84}));
        });
        state.SetIterationTime(timer.median());
    }
}

/// Asks for the same picture many times.
class Many : public render::Observation {
  public:
    explicit Many(const Picture& picture)
        : rig_(rig_of(picture)),
          weather_(world::find_weather(picture.weather)->weather) {}

    world::TickView tick() const override { return scene().next(); }

    const world::SensorRig& rig() const override { return rig_; }

    const world::Weather& weather() const override { return weather_; }

    void seen(std::vector<world::SensorFrame> frames) override {
        benchmark::DoNotOptimize(frames.data());
    }

  private:
    world::SensorRig rig_;
    world::Weather weather_;
};

constexpr int many = 12;

/// Seconds by the clock for `many` pictures.
double time_many(const Picture& picture, int threads) {
    render::Sensors sensors(scene().recording.town, {.threads = threads});
    bench::Timer timer;
    for (int turn = 0; turn < 3; ++turn) {
        int left = many;
        timer.time([&] {
            sensors.observe_each([&]() -> std::unique_ptr<render::Observation> {
                return left-- > 0 ? std::make_unique<Many>(picture) : nullptr;
            });
        });
    }
    return timer.median();
}

/// Seconds by the clock for the picture's bare rays in each of so many threads.
double time_bare(std::span<const bench::TracedPacket> packets, int threads) {
    bench::Timer timer;
    for (int turn = 0; turn < 3; ++turn)
        timer.time([&] {
            std::vector<std::jthread> all;
            for (int i = 0; i < threads; ++i)
                all.emplace_back([&] { bench::trace_again(packets); });
        });
    return timer.median();
}

void Threads(benchmark::State& state) {
    const Picture picture{{SensorKind::rgb}, 400, 300};
    const double one = time_many(picture, 1);
    const double two = time_many(picture, 2);
    double bare = 0;
    {
        render::Sensors sensors(scene().recording.town, {.threads = 1});
        observe(sensors, picture);
        const auto packets = bench::traced_packets([&] { observe(sensors, picture); });
        bare = 2 * time_bare(packets, 1) / time_bare(packets, 2);
    }
    for (auto _ : state)
        state.SetIterationTime(two / many);
    state.counters["times_one"] = one / two;
    state.counters["bare_times_one"] = bare;
}

/// Its own turns are what repeats it.
void once(benchmark::internal::Benchmark* look) {
    look->Unit(benchmark::kMillisecond)->Iterations(1)->UseManualTime();
}

BENCHMARK_CAPTURE(look, depth, Picture{{SensorKind::depth}, 800, 600})->Apply(once);
BENCHMARK_CAPTURE(look, semantic, Picture{{SensorKind::semantic}, 800, 600})->Apply(once);
BENCHMARK_CAPTURE(look, rgb_clear_noon, Picture{{SensorKind::rgb}, 800, 600})->Apply(once);
BENCHMARK_CAPTURE(look,
                  rgb_hard_rain_sunset,
                  Picture{{SensorKind::rgb}, 800, 600, "hard_rain_sunset"})
    ->Apply(once);
BENCHMARK_CAPTURE(look, rgb_clear_night, Picture{{SensorKind::rgb}, 800, 600, "clear_night"})
    ->Apply(once);
BENCHMARK(Night)->Apply(once);
BENCHMARK_CAPTURE(look, labels, Picture{{SensorKind::depth, SensorKind::semantic}, 800, 600})
    ->Apply(once);
BENCHMARK_CAPTURE(look, rgb_84x84, Picture{{SensorKind::rgb}, 84, 84})->Apply(once);
BENCHMARK_CAPTURE(look, semantic_84x84, Picture{{SensorKind::semantic}, 84, 84})->Apply(once);
BENCHMARK_CAPTURE(look, rgb_200x88, Picture{{SensorKind::rgb}, 200, 88})->Apply(once);
BENCHMARK_CAPTURE(look, semantic_200x88, Picture{{SensorKind::semantic}, 200, 88})->Apply(once);
BENCHMARK_CAPTURE(sweep, semantic_64x2048, SensorKind::semantic_lidar, "clear_noon")->Apply(once);
BENCHMARK_CAPTURE(sweep, lidar_64x2048, SensorKind::lidar, "clear_noon")->Apply(once);
BENCHMARK_CAPTURE(sweep, lidar_rain_64x2048, SensorKind::lidar, "hard_rain_noon")->Apply(once);
BENCHMARK(StartUp)->Unit(benchmark::kMillisecond)->Iterations(5)->UseManualTime();
BENCHMARK(Threads)->Apply(once);

}  // namespace

BENCHMARK_MAIN();
