#include "cli/options/tick_range.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/options/tick_option.h"
#include "world/check.h"

namespace reprise::cli {

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
        range.first = std::max(range.first, parse_tick(option, from, step_ns, range.first));
    if (dots == std::string::npos || !to.empty())
        range.last = std::min(range.last, parse_tick(option, to, step_ns, range.last));
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
