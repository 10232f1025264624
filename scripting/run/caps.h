#pragma once

#include <cstddef>

namespace reprise::scripting {

// What a scenario may ask of the world. A tick with all of it takes about a second; the kernel's
// work is not in the script's budget. Each is a mistake at the script's line.
inline constexpr std::size_t most_present_actors = 1'000;  ///< there, or about to be
inline constexpr std::size_t most_driven_actors =
    300;  ///< of them with a body of their own in physics
// Bodies that stand in each other: a tick of 1,000 in one place takes 7 s and 1.2 GB.
inline constexpr double place_radius = 5;           ///< [m] of a place
inline constexpr std::size_t most_in_a_place = 12;  ///< vehicles; twice what fits
inline constexpr std::size_t most_props_in_a_place = 30;
inline constexpr std::size_t most_actors = 10'000;   ///< spawned in a run
inline constexpr std::size_t most_commands = 2'000;  ///< in a tick
inline constexpr std::size_t most_events = 1'000;    ///< in a tick: printed lines, failed checks
inline constexpr std::size_t most_printed = std::size_t{256} << 10U;         ///< [bytes] in a tick
inline constexpr std::size_t most_printed_in_run = std::size_t{256} << 20U;  ///< [bytes]
inline constexpr std::size_t most_checks = 1'000;
inline constexpr std::size_t most_tasks = 2'000;    ///< at a time
inline constexpr std::size_t most_streams = 1'000;  ///< of random numbers
inline constexpr std::size_t longest_route = 100;   ///< lanes and edges

}  // namespace reprise::scripting
