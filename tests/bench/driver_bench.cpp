// What it costs that another program drives, with 100 cars: the built-in driver, and the same
// control said by this process itself, by a driver in C++, and by drivers in Python without and
// with cameras. Each drives a run in a process of its own, in turns of a few ticks; beside them
// bare round trips of the same bytes. What asking adds is the difference between ticks in which it
// is asked and others of the same run, in turns: two processes that do the same differ by
// 40 us a tick, two turns of one by 5. Figures are medians of ticks, and of laps of that
// difference.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "kernel/kernel.h"
#include "remote/seat.h"
#include "tests/bench/bare_child.h"
#include "tests/bench/drive.h"
#include "tests/bench/lane.h"
#include "tests/bench/stopwatch.h"
#include "tests/bench/timer.h"
#include "world/external/external_drivers.h"

namespace {

using namespace reprise;

constexpr int warm_up = 200;   // [ticks] until queues have formed, without drivers
constexpr unsigned turn = 10;  // [ticks]
constexpr unsigned not_counted = 5;
const std::string asleep = " 0";  // [s] of polling
constexpr std::uint32_t actor = 1;
const std::string source = REPRISE_SOURCE;
const std::string python = "PYTHONPATH=" + source + "/python exec /usr/bin/python3 -B " + source +
                           "/tests/bench/idle_driver.py";

enum class Asks { nobody, round_trip, seat, waiting_seat };

/// What a lane is.
struct Plan {
    Asks asks = Asks::nobody;
    std::string command{};  ///< of the driver
    std::string driver = "external";
    std::string cameras = "none";
};

/// What tests/bench/idle_driver.* say as well.
world::Control idle(const world::TickView& tick) {
    const bool slow = world::find(tick.measurements(), actor)->speed() < 5;
    return {slow ? 0.4 : 0.0, 0, 0, actor, 0, false, false};
}

/// A run, and who drives in it.
class Run {
  public:
    Run(world::Recording recording, Plan plan)
        : plan_(std::move(plan)),
          recording_(std::move(recording)),
          kernel_(recording_),
          tick_(&kernel_.step()) {
        drivers_.hear(*tick_->view().tick);
        while (tick_->view().index() < warm_up)
            step(idle(tick_->view()));
        if (plan_.asks == Asks::round_trip)
            child_.emplace();
        if (plan_.command.empty())
            return;
        seat_ = std::make_unique<remote::Seat>(remote::SeatPlan{"ego", plan_.command},
                                               remote::Patience());
        const auto& spawn = drivers_.spawns().at(actor);
        const remote::Spawned spawned{.command = &spawn.command,
                                      .tick = spawn.tick,
                                      .now = tick_->view().index(),
                                      .render_program = "exec '" RENDER_PROGRAM "' live"};
        if (const auto lost = seat_->take(actor, recording_, spawned))
            throw std::runtime_error(lost->reason);
    }

    /// So many ticks in which it is asked, and as many in which nobody is. Which of them come first
    /// changes: of two turns in which nobody is asked, the first always took 10 us a tick more.
    bench::Lap run(unsigned ticks) {
        Ticks asked, alone;
        for (unsigned done = 0; done < ticks; done += 2 * turn) {
            take_turn(asked, true);
            take_turn(alone, false);
            take_turn(alone, false);
            take_turn(asked, true);
        }
        const auto bytes = tick_->tick_bytes().size() + tick_->traffic_bytes().size();
        return {asked.each.median(),
                asked.cpu / ticks,
                static_cast<double>(bytes),
                tick_->view().tick->digests()->chain(),
                alone.each.median(),
                alone.cpu / ticks};
    }

  private:
    struct Ticks {
        bench::Timer each;  ///< one slow tick of a busy machine does not count
        double cpu = 0;     ///< [s] of all
    };

    /// The first few do not count: who was not asked for a while is asleep, or has to be woken more
    /// often than one who is asked in every tick of a run.
    void take_turn(Ticks& ticks, bool asks) {
        const auto tick = [&] { step(asks ? ask() : idle(tick_->view())); };
        for (unsigned i = 0; i < not_counted; ++i)
            tick();
        bench::Best all;
        all.time([&] {
            for (unsigned i = 0; i < turn; ++i)
                ticks.each.time(tick);
        });
        ticks.cpu += all.cpu;
    }

    void step(const world::Control& control) { tick_ = &kernel_.step({&control, 1}); }

    /// As a run asks a driver.
    world::Control ask() {
        if (child_)
            child_->round_trip(tick_->tick_bytes().size() + tick_->traffic_bytes().size());
        if (!seat_)
            return idle(tick_->view());
        if (const auto lost = seat_->show(*tick_))
            throw std::runtime_error(lost->reason);
        if (plan_.asks != Asks::waiting_seat)
            kernel_.begin_step();
        const auto answer = seat_->answer();
        if (const auto* lost = std::get_if<remote::Lost>(&answer))
            throw std::runtime_error(lost->reason);
        return std::get<world::Control>(answer);
    }

    Plan plan_;
    world::Recording recording_;
    kernel::Kernel kernel_;
    const world::SealedTick* tick_;
    world::ExternalDrivers drivers_;
    std::unique_ptr<remote::Seat> seat_;
    std::optional<bench::BareChild> child_;
};

bench::Lane make_lane(const world::Recording& town1, const Plan& plan) {
    return bench::Lane([&] {
        world::Recording recording = town1;
        recording.episode = scripting::load_episode(
            source + "/tests/bench/driven.lua",
            {{}, 7, 36000.0, {{"driver", plan.driver}, {"cameras", plan.cameras}}});
        auto run = std::make_shared<Run>(std::move(recording), plan);
        return [run](unsigned ticks) { return run->run(ticks); };
    });
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Medians over the rounds.
struct Course {
    double tick_us = 0;      ///< of the clock
    double adds_us = 0;      ///< to a tick that nobody is asked in
    double adds_cpu_us = 0;  ///< of the process that simulates
};

Course course_of(const std::vector<bench::Lap>& laps) {
    std::vector<double> wall, adds, adds_cpu;
    for (const bench::Lap& lap : laps) {
        wall.push_back(1e6 * lap.wall);
        adds.push_back(1e6 * (lap.wall - lap.alone));
        adds_cpu.push_back(1e6 * (lap.cpu - lap.alone_cpu));
    }
    return {median(wall), median(adds), median(adds_cpu)};
}

using Plans = std::vector<std::pair<std::string, Plan>>;
using Laps = std::map<std::string, std::vector<bench::Lap>>;

/// So many turns of each.
Laps drive(const Plans& plans, unsigned rounds, unsigned ticks) {
    const world::Recording town1 = bench::in_town1("tests/bench/driven.lua");
    std::vector<bench::Lane> lanes;
    for (const auto& [name, plan] : plans)
        lanes.push_back(make_lane(town1, plan));
    Laps laps;
    for (unsigned round = 0; round <= rounds; ++round)
        for (std::size_t i = 0; i < lanes.size(); ++i) {
            const bench::Lap lap = lanes[i].run(ticks);
            if (round > 0)  // in the first, modules are imported, and the town's scene is made
                laps[plans[i].first].push_back(lap);
        }
    return laps;
}

double ticks_a_second(const Laps& laps, const char* name) {
    return 1e6 / course_of(laps.at(name)).tick_us;
}

void Driver(benchmark::State& state) {
    Laps laps;
    for ([[maybe_unused]] const auto _ : state) {
        laps = drive({{"alone", {}},
                      {"built_in", {Asks::nobody, "", "autopilot"}},
                      {"bare", {Asks::round_trip}},
                      {"cpp", {Asks::seat, IDLE_DRIVER}},
                      {"cpp_asleep", {Asks::seat, IDLE_DRIVER + asleep}},
                      {"cpp_waiting", {Asks::waiting_seat, IDLE_DRIVER}},
                      {"python", {Asks::seat, python}},
                      {"python_asleep", {Asks::seat, python + asleep}},
                      {"python_waiting", {Asks::waiting_seat, python}}},
                     25,
                     40);
        state.SetIterationTime(laps["alone"].back().wall);
    }
    for (const auto& [name, own] : laps)
        if (name != "built_in" && own.back().chain != laps["alone"].back().chain)
            state.SkipWithError("the drivers did not drive alike");
    const auto course = [&](const char* name) { return course_of(laps[name]); };
    state.counters["ticks/s_built_in"] = ticks_a_second(laps, "built_in");
    state.counters["ticks/s_alone"] = ticks_a_second(laps, "alone");
    state.counters["ticks/s_cpp"] = ticks_a_second(laps, "cpp");
    state.counters["ticks/s_python"] = ticks_a_second(laps, "python");
    state.counters["ticks/s_cpp_asleep"] = ticks_a_second(laps, "cpp_asleep");
    state.counters["ticks/s_python_asleep"] = ticks_a_second(laps, "python_asleep");
    state.counters["observation_B"] = laps["alone"].back().bytes;
    state.counters["nobody_us"] = course("alone").adds_us;  // how far two equal turns are apart
    state.counters["bare_us"] = course("bare").adds_us;
    state.counters["cpp_us"] = course("cpp").adds_us;
    state.counters["cpp_asleep_us"] = course("cpp_asleep").adds_us;
    state.counters["cpp_waiting_us"] = course("cpp_waiting").adds_us;
    state.counters["python_us"] = course("python").adds_us;
    state.counters["python_asleep_us"] = course("python_asleep").adds_us;
    state.counters["python_waiting_us"] = course("python_waiting").adds_us;
    state.counters["bare_cpu_us"] = course("bare").adds_cpu_us;
    state.counters["cpp_cpu_us"] = course("cpp").adds_cpu_us;
}

void Cameras(benchmark::State& state) {
    Laps laps;
    for ([[maybe_unused]] const auto _ : state) {
        laps = drive({{"alone", {}},
                      {"python", {Asks::seat, python}},
                      {"rgb84", {Asks::seat, python, "external", "rgb84"}},
                      {"rgb200x88", {Asks::seat, python, "external", "rgb200x88"}},
                      {"three800x600", {Asks::seat, python, "external", "three800x600"}}},
                     3,
                     20);
        state.SetIterationTime(laps["three800x600"].back().wall);
    }
    state.counters["ticks/s_python"] = ticks_a_second(laps, "python");
    state.counters["ticks/s_rgb84"] = ticks_a_second(laps, "rgb84");
    state.counters["ticks/s_rgb200x88"] = ticks_a_second(laps, "rgb200x88");
    state.counters["ticks/s_three800x600"] = ticks_a_second(laps, "three800x600");
}

BENCHMARK(Driver)->Iterations(1)->UseManualTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(Cameras)->Iterations(1)->UseManualTime()->Unit(benchmark::kMicrosecond);

/// One after the other, while nothing else is done: 1 kB, an observation, and with it the pixels of
/// the cameras above, which really stay where they are.
void RoundTrip(benchmark::State& state) {
    bench::BareChild child;
    for ([[maybe_unused]] const auto _ : state)
        child.round_trip(static_cast<std::size_t>(state.range(0)));
    state.counters["B"] = static_cast<double>(state.range(0));
}

constexpr int observation = 7'300;
BENCHMARK(RoundTrip)
    ->Arg(1'000)
    ->Arg(observation)
    ->Arg(observation + 84 * 84 * 3)
    ->Arg(observation + 200 * 88 * 3)
    ->Arg(observation + 800 * 600 * (3 + 4 + 1))
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
