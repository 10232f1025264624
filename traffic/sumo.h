#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "world/episode_generated.h"

namespace reprise::traffic {

/// The process's one libsumo simulation, from construction to destruction.
class SumoProcess {
  public:
    /// Starts SUMO with the network's bytes and the fleet's vehicle types, both handed over in
    /// memory. Throws world::Error with SUMO's own words when it refuses the network.
    SumoProcess(const world::EpisodeT& episode, std::string_view network);
    ~SumoProcess();
    SumoProcess(const SumoProcess&) = delete;
    SumoProcess& operator=(const SumoProcess&) = delete;
};

/// SUMO's id of an actor: ten digits, so that the order of texts is the order of numbers.
std::string sumo_id(std::uint32_t actor);

/// SUMO's degrees clockwise from north.
double sumo_angle_deg(double yaw);

/// SUMO's seed is a signed int: both halves of ours, folded into [0, 2^31).
std::uint32_t sumo_seed(std::uint64_t seed);

}  // namespace reprise::traffic
