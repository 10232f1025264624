// Episodes of one's own: a task of the CARLA paper with three seeds, at a server that this program
// starts; or, as episodes SCENARIO.lua TRACE.mcap, a scenario of this folder, which is recorded.
#include <cstdio>

#include <fmt/format.h>

#include "remote/simulation.h"
#include "world/check.h"
#include "world/tick.h"

using namespace reprise;

/// Straight on, no faster than 8 m/s.
remote::Client::Wheel decide(const world::TickView& tick, std::uint32_t actor) {
    const world::Measurement* own = world::find(tick.measurements(), actor);
    return {.throttle = own != nullptr && own->speed() < 8 ? 0.5 : 0.0};
}

void play(int count, char** words) {
    remote::Simulation sim;
    remote::EpisodePlan plan{.town = "town1", .cars = 20, .goal = remote::Drawn{}, .seconds = 10};
    if (count > 2)
        plan = {.file = words[1], .trace = words[2]};
    for (const std::uint64_t seed : {1, 2, 3}) {
        plan.seed = seed;
        auto tick = sim.reset(plan);
        while (tick)
            tick = sim.step(decide(*tick, sim.run().actor()));
        fmt::print("seed {}: {} after {} ticks: {}\n",
                   seed,
                   sim.outcome().verdict,
                   sim.outcome().ticks,
                   sim.outcome().reason);
    }
}

int main(int count, char** words) {
    try {
        play(count, words);
    } catch (const world::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
    return 0;
}
