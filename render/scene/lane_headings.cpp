#include "render/scene/lane_headings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reprise::render {

LaneHeadings::LaneHeadings(const world::TownT& town) {
    for (const world::LaneT& lane : town.lanes) {
        first_.push_back(static_cast<std::uint32_t>(knots_.size()));
        double s = 0;
        double last = 0;
        for (std::size_t i = 1; i < lane.centre.size(); ++i) {
            const double dx = lane.centre[i].x() - lane.centre[i - 1].x();
            const double dy = lane.centre[i].y() - lane.centre[i - 1].y();
            const double piece = std::sqrt(dx * dx + dy * dy);
            if (piece < 1e-6)
                continue;
            double heading = std::atan2(dy, dx);
            if (knots_.size() > first_.back())
                heading = last + std::remainder(heading - last, 2 * std::numbers::pi);
            knots_.push_back({static_cast<float>(s + piece / 2), static_cast<float>(heading)});
            last = heading;
            s += piece;
        }
    }
    first_.push_back(static_cast<std::uint32_t>(knots_.size()));
}

std::optional<double> LaneHeadings::at(std::uint32_t lane, double s) const {
    if (lane >= first_.size() - 1 || first_[lane] == first_[lane + 1])
        return std::nullopt;
    const auto begin = knots_.begin() + first_[lane];
    const auto end = knots_.begin() + first_[lane + 1];
    const auto next = std::upper_bound(begin, end, s, [](double at, const Knot& knot) {
        return at < static_cast<double>(knot.s);
    });
    if (next == begin)
        return static_cast<double>(begin->heading);
    if (next == end)
        return static_cast<double>((end - 1)->heading);
    const Knot& before = *(next - 1);
    const double share =
        (s - static_cast<double>(before.s)) / static_cast<double>(next->s - before.s);
    return static_cast<double>(before.heading) +
           share * static_cast<double>(next->heading - before.heading);
}

}  // namespace reprise::render
