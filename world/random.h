#pragma once

#include <cstdint>

namespace reprise::world {

/// What a random number is for. A new use gets a new value at the end, so that adding one draw
/// never shifts another. Values are part of the recorded behaviour: never renumber.
enum class Purpose : std::uint32_t {
    scenario,      ///< item: count of draws of the named stream
    place,         ///< where a car without a place is put
    demand_place,  ///< where a background car starts
    demand_model,  ///< which model it is
    demand_route,  ///< which way it turns
    driver_route,  ///< which way the autopilot turns
    building = 7,  ///< 6 was given away once
    tree,
    camera_noise,
    rain_drop,
    building_model,  ///< which of the building models stands somewhere
    plant,           ///< where which bush, hedge or tree grows
    furniture,       ///< where benches, bins, parked cars and the like stand
    spawn_point,     ///< which places of a lane are worth starting from
    look,            ///< an actor's paint or outfit; item: its id
    walker,          ///< who a background walker is; tick: which question, item: the id
    walker_place,    ///< where one appears; tick: which try, item: the id
    walker_goal      ///< where one goes, and what he does there; tick: which draw, item: the id
};

/// A uniform number in [0, 1), as a pure function of its arguments: there is no generator to seed,
/// share, save or advance, and draws may be made in any order on any thread.
/// Mixer: splitmix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators",
/// OOPSLA 2014).
constexpr double draw(std::uint64_t seed, std::uint64_t tick, Purpose purpose, std::uint64_t item) {
    auto mix = [](std::uint64_t z) {
        z += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    };
    const std::uint64_t bits =
        mix(mix(mix(mix(seed) ^ tick) ^ static_cast<std::uint64_t>(purpose)) ^ item);
    return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

/// A uniform index in [0, count). `count` must not be 0.
constexpr std::uint64_t draw_index(std::uint64_t count,
                                   std::uint64_t seed,
                                   std::uint64_t tick,
                                   Purpose purpose,
                                   std::uint64_t item) {
    return static_cast<std::uint64_t>(draw(seed, tick, purpose, item) * static_cast<double>(count));
}

}  // namespace reprise::world
