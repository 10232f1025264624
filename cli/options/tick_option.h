#pragma once

#include <cstdint>
#include <string>

namespace reprise::cli {

/// "120" and "120t" are ticks; "10s" and, because no tick has a decimal point, "2.5" are times,
/// rounded to the nearest tick; "" the fallback. Throws world::Error that names the option.
std::uint64_t parse_tick(const std::string& option,
                         const std::string& text,
                         std::uint64_t step_ns,
                         std::uint64_t fallback);

}  // namespace reprise::cli
