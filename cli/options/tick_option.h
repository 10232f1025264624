#pragma once

#include <cstdint>
#include <string>

namespace reprise::cli {

/// Whether "120" without a unit is a tick, as where the option speaks of ticks, or refused.
enum class BareNumber : std::uint8_t { tick, refused };

/// "120t" is a tick, "10s" and "2.5s" are times, rounded to the nearest tick; "" the fallback.
/// Throws world::Error that names the option, also for "2.5": beside "2" it would be another kind
/// of thing.
std::uint64_t parse_tick(const std::string& option,
                         const std::string& text,
                         std::uint64_t step_ns,
                         std::uint64_t fallback,
                         BareNumber bare = BareNumber::tick);

}  // namespace reprise::cli
