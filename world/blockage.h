#pragma once

#include <cstdint>

#include "world/tick_generated.h"

namespace reprise::world {

/// A vehicle with mass is blocked when it has been on its way for a minute without moving: slower
/// than 0.1 m/s without a break, as CARLA's leaderboard counts (which waits for three minutes).
/// Longer than the red phase of any sensible signal. Who was told to stand, or can go nowhere, is
/// not on its way.
inline constexpr double halted_speed = 0.1;                           // [m/s]
inline constexpr std::uint64_t blocked_after_ns = 60'000'000'000ULL;  // 60 s

/// `measured` of a run with this step.
inline bool is_blocked(const Measurement& measured, std::uint64_t step_ns) {
    return measured.halted_ticks() * step_ns >= blocked_after_ns;
}

}  // namespace reprise::world
