#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scripting/lua/literals.h"
#include "scripting/run/weathers.h"

namespace reprise::scripting {

class Vm;

/// What `return scenario 'name' { ... }` says before anything runs.
struct Header {
    std::string name;
    std::string town = "town1";
    SaidWeather weather;                 ///< at the start
    std::vector<WeatherEntry> timeline;  ///< behind the start, by time
    std::optional<double> friction;      ///< of the whole run, whatever the weather
    double duration = 60;                ///< [s]
    bool has_duration = false;
    std::string of_world;  ///< a key that decides the world at the start, or ""
    std::uint64_t seed = 0;
    std::uint32_t cars = 0;  ///< world::auto_cars: as many as the town carries
    std::uint32_t walkers = 0;
    std::optional<std::uint64_t> walker_seed;  ///< none: `seed`
    double jaywalkers = 0.1;                   ///< share of the walkers
    std::map<std::string, Value> parameters;
    std::uint32_t line = 0;
    int run = 0;  ///< the function, in Lua's registry
};

/// Fills the machine with the whole vocabulary, runs the scenario's file in it and returns its
/// header. Throws world::Error with file and line.
Header read_header(Vm& vm, const std::string& source);

}  // namespace reprise::scripting
