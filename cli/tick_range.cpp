#include "cli/tick_range.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "world/check.h"

namespace reprise::cli {

std::uint64_t parse_tick(const std::string& option,
                         const std::string& text,
                         std::uint64_t step_ns) {
    const bool is_time = !text.empty() && text.back() == 's';
    const char* begin = text.data();
    const char* end = begin + text.size() - (is_time ? 1 : 0);
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    const bool whole = is_time || value == std::floor(value);
    constexpr double most = 1e12;
    if (error != std::errc() || stop != end || !(value >= 0 && value < most) || !whole)
        throw world::Error(option + ": expected a tick such as 120 or a time such as 2.5s, got '" +
                           text + "'");
    return is_time ? static_cast<std::uint64_t>(
                         std::llround(value * 1e9 / static_cast<double>(step_ns)))
                   : static_cast<std::uint64_t>(value);
}

TickRange parse_ticks(const std::string& option,
                      const std::string& text,
                      const replay::TraceReader& trace) {
    const std::uint64_t step_ns = trace.episode().step_ns;
    TickRange range{trace.first(), trace.last()};
    if (text.empty())
        return range;
    const std::size_t dots = text.find("..");
    const std::string from = text.substr(0, dots);
    const std::string to = dots == std::string::npos ? from : text.substr(dots + 2);
    if (dots == std::string::npos || !from.empty())
        range.first = std::max(range.first, parse_tick(option, from, step_ns));
    if (dots == std::string::npos || !to.empty())
        range.last = std::min(range.last, parse_tick(option, to, step_ns));
    if (range.first > range.last)
        throw world::Error(fmt::format("{} {}: no such ticks; {} holds {} to {}",
                                       option,
                                       text,
                                       trace.path().string(),
                                       trace.first(),
                                       trace.last()));
    return range;
}

}  // namespace reprise::cli
