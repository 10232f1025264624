#include "wheel/dashboard.h"

#include <cmath>

#include <fmt/format.h>

namespace reprise::wheel {

namespace {

constexpr double kmh = 3.6;

std::string turn_text(remote::Turning turning) {
    switch (turning) {
        case remote::Turning::left:
            return "turn left";
        case remote::Turning::right:
            return "turn right";
        case remote::Turning::straight:
            return "straight on";
        default:
            return "follow the lane";
    }
}

}  // namespace

std::string to_line(const Dashboard& told) {
    std::string line =
        fmt::format("{:.0f} km/h  {}", std::abs(told.speed) * kmh, told.reverse ? 'R' : 'D');
    if (told.limit)
        line += fmt::format("  limit {:.0f}", *told.limit * kmh);
    if (told.gap)
        line += fmt::format("  gap {:.0f} m", *told.gap);
    if (told.way.turning != remote::Turning::none)
        line += fmt::format("  {}, goal {:.0f} m", turn_text(told.way.turning), told.way.to_goal);
    const auto seconds = static_cast<long>(told.time);
    line += fmt::format("  {}:{:02}", seconds / 60, seconds % 60);
    if (told.factor > 0)
        line += fmt::format("  {:.2f} x real time", told.factor);
    return told.paused ? line + "  paused" : line;
}

}  // namespace reprise::wheel
