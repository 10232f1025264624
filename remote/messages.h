#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "remote/guide.h"
#include "remote/picture_ring.h"
#include "remote/wire_generated.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::remote {

/// What the run says first, to a driver and to the process that renders for it.
struct Greeting {
    std::uint32_t actor = 0;
    std::string name;                        ///< the scenario's
    const world::CommandT* spawn = nullptr;  ///< null: not known
    const world::CommandT* route = nullptr;  ///< to be driven already; null: none
    std::size_t shared_bytes = 0;            ///< of the memory whose descriptor goes with it
    bool with_network = false;               ///< for who asks where the town lies
};

/// A message as it is packed. The bytes live as long as it.
using Packed = flatbuffers::FlatBufferBuilder;

std::span<const std::uint8_t> bytes_of(const Packed& message);

Packed pack_hello(const Greeting& greeting, const world::Recording& recording);

/// `memory`: null where the other end looks into it itself; else the pictures go along. Readings
/// always do. `passed`: ticks since the last observation.
Packed pack_observation(std::span<const std::uint8_t> tick,
                        std::span<const std::uint8_t> traffic,
                        std::span<const PlacedPicture> pictures,
                        const std::uint8_t* memory,
                        const Guidance& guidance = {},
                        std::span<const std::vector<std::uint8_t>> passed = {});

/// What a vehicle knows of itself, as a world.Tick: index, its control, state, wheels and
/// measurement (its gap_ahead, which is seen and not felt, is nan). All else is empty or zero.
std::vector<std::uint8_t> own_tick(const world::TickView& tick, std::uint32_t actor);

}  // namespace reprise::remote
