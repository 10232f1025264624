#include "cli/options/tick_option.h"

#include <charconv>
#include <cmath>

#include "world/check.h"

namespace reprise::cli {

std::uint64_t parse_tick(const std::string& option,
                         const std::string& text,
                         std::uint64_t step_ns,
                         std::uint64_t fallback,
                         BareNumber bare) {
    if (text.empty())
        return fallback;
    const bool has_unit = text.back() == 's' || text.back() == 't';
    const bool is_time = text.back() == 's';
    const char* begin = text.data();
    const char* end = begin + text.size() - (has_unit ? 1 : 0);
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    const bool is_number = error == std::errc() && stop == end;
    if (is_number && !has_unit &&
        (bare == BareNumber::refused || text.find('.') != std::string::npos))
        throw world::Error(option + " " + text + ": ticks or seconds? Write " + text +
                           "s for seconds, " + text.substr(0, text.find('.')) + "t for a tick");
    const bool whole = is_time || value == std::floor(value);
    constexpr double most = 1e12;
    if (!is_number || !(value >= 0 && value < most) || !whole)
        throw world::Error(option + ": expected a tick such as 120t or a time such as 2.5s, got '" +
                           text + "'");
    return is_time ? static_cast<std::uint64_t>(
                         std::llround(value * 1e9 / static_cast<double>(step_ns)))
                   : static_cast<std::uint64_t>(value);
}

}  // namespace reprise::cli
