#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "exchange/carla/carla_log.h"
#include "exchange/carla/carla_ticks.h"
#include "world/episode_generated.h"
#include "world/town_generated.h"

namespace reprise::exchange {

/// The road network of the map that was recorded on.
struct CarlaTown {
    world::TownT town;
    std::string path;
    std::string network;  ///< bytes of the SUMO network
};

struct CarlaImportOptions {
    std::string name;               ///< of the log, without its folder
    std::optional<CarlaTown> town;  ///< none: a plain
    CarlaTiming timing;
    std::vector<world::ParameterT> fingerprint;   ///< of this build
    std::function<void(std::uint64_t)> progress;  ///< bytes done, of twice the log's size
};

/// What an import did, and what it could not.
struct CarlaReport {
    std::string source;  ///< as the trace says it
    std::uint64_t frames = 0;
    std::uint64_t ticks = 0;
    std::uint64_t vehicles = 0;
    std::uint64_t walkers = 0;
    std::vector<std::string> guessed;  ///< "vehicle.x.y: sedan, by its size", each blueprint once
    std::uint64_t lights = 0;          ///< in the log
    std::uint64_t signals = 0;         ///< of the town
    std::uint64_t matched = 0;         ///< of these
    std::uint64_t jumps = 0;
    double low = 0;  ///< [m] heights that were driven at, and the highest
    double high = 0;
    std::optional<CarlaDamage> damage;
    std::uint64_t lost = 0;  ///< bytes behind the last whole frame
    std::map<std::uint8_t, std::uint64_t> skipped;
};

/// Writes a trace of poses: no physics, no inputs, nothing to simulate it from. Cars and walkers
/// are in Traffic, under CARLA's ids. Throws world::Error, and writes nothing, when the log holds
/// no vehicle or walker, or less than one step.
CarlaReport import_carla(CarlaBytes bytes,
                         const CarlaImportOptions& options,
                         const std::filesystem::path& trace);

}  // namespace reprise::exchange
