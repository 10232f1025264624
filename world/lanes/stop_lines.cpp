#include "world/lanes/stop_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "world/frames.h"
#include "world/units.h"

namespace reprise::world {

namespace {

constexpr double beside_lane = 0.5;     ///< [m] a line reaches so far beyond its lane
constexpr double misfit_per_rad = 4;    ///< [m], as LaneMap::best weighs
constexpr double clear_lead = 1;        ///< [m] by which one turning must fit better,
constexpr double inside = 3;            ///< [m] once the rear axle is so far behind the line
constexpr double around = 1;            ///< [rad] who has turned so far is not before it any more
constexpr double turn_is_over = 60;     ///< [m] behind the line
constexpr std::size_t longest_way = 8;  ///< internal lanes of one link

bool has_signal(const Link& link) {
    return link.signal() != none;
}

std::vector<std::uint32_t> lanes_with_signals(const TownT& town) {
    std::vector<std::uint32_t> lanes;
    for (std::uint32_t index = 0; index < town.lanes.size(); ++index) {
        const LaneT& lane = town.lanes[index];
        if (lane.kind == LaneKind::driving &&
            std::any_of(lane.links.begin(), lane.links.end(), has_signal))
            lanes.push_back(index);
    }
    return lanes;
}

/// How badly a lane fits a vehicle there. [m]
double misfit(const LaneT& lane, const Eigen::Vector3d& p_world, double yaw) {
    const LaneProjection at = project(lane, p_world);
    return at.distance + misfit_per_rad * std::abs(wrap_angle(point_at(lane, at.s).yaw - yaw));
}

/// The best fit of the lanes through the junction and behind it.
double misfit(const TownT& town, const Link& link, const Eigen::Vector3d& p_world, double yaw) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t lane = link.via();
    for (std::size_t i = 0; i < longest_way && lane != none && lane != link.to(); ++i) {
        least = std::min(least, misfit(town.lanes[lane], p_world, yaw));
        const std::vector<Link>& links = town.lanes[lane].links;
        lane = links.empty() ? none : links.front().via();
    }
    return link.to() == none ? least : std::min(least, misfit(town.lanes[link.to()], p_world, yaw));
}

}  // namespace

StopLines::StopLines(const TownT& town) : StopLines(town, lanes_with_signals(town)) {}

StopLines::StopLines(const TownT& town, std::span<const std::uint32_t> lanes) {
    std::vector<BoxGrid::Entry> entries;
    for (const std::uint32_t index : lanes) {
        const LaneT& lane = town.lanes[index];
        const LanePoint end = point_at(lane, lane.length);
        const Eigen::Vector2d ahead = ahead_of(end.yaw);
        const Eigen::Vector3d middle =
            end.position + slack * Eigen::Vector3d(ahead.x(), ahead.y(), 0);
        Box box;
        box.take(middle.head<2>(), lane.width / 2 + beside_lane);
        entries.push_back({box, static_cast<std::uint32_t>(lines_.size())});
        lines_.push_back({middle, ahead, lane.width / 2, index});
    }
    grid_ = BoxGrid(entries);
}

std::optional<std::uint32_t> StopLines::crossed(const Eigen::Vector3d& from,
                                                const Eigen::Vector3d& to) const {
    if (lines_.empty() || from == to)
        return std::nullopt;
    Box box;
    box.take(from.head<2>());
    box.take(to.head<2>());
    std::optional<std::uint32_t> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t index : grid_.near(box)) {
        const Line& line = lines_[index];
        const double before = (from - line.middle).head<2>().dot(line.ahead);
        const double behind = (to - line.middle).head<2>().dot(line.ahead);
        if (before > 0 || behind <= 0 || std::abs(to.z() - line.middle.z()) > level_clearance)
            continue;
        const Eigen::Vector3d at = from + (to - from) * (before / (before - behind));
        const double aside = std::abs(cross(line.ahead, (at - line.middle).head<2>()));
        if (aside > line.half_width + beside_lane || aside - line.half_width >= least)
            continue;
        least = aside - line.half_width;
        nearest = line.lane;
    }
    return nearest;
}

void RedLightWatch::observe(const TownT& town,
                            const StopLines& lines,
                            const TickView& tick,
                            const Eigen::Vector3d& p_rear,
                            double yaw,
                            double front,
                            double farthest) {
    const Eigen::Vector2d ahead = ahead_of(yaw);
    const Eigen::Vector3d p_front = p_rear + front * Eigen::Vector3d(ahead.x(), ahead.y(), 0);
    const std::optional<Eigen::Vector3d> before = p_front_;
    p_front_ = p_front;
    if (lane_ != none)
        decide(town, p_rear, yaw, clear_lead);
    if (!before || (p_front - *before).norm() > farthest)
        return;
    const auto lane = lines.crossed(*before, p_front);
    if (!lane)
        return;
    if (lane_ != none)  // the next line: which way it took to here is as clear as it gets
        decide(town, p_rear, yaw, 0);
    cross(town, tick, *lane);
}

void RedLightWatch::cross(const TownT& town, const TickView& tick, std::uint32_t lane) {
    red_.clear();
    for (const Link& link : town.lanes[lane].links)
        red_.push_back(link.signal() < tick.signals().size() &&
                       is_red(tick.signals()[link.signal()]));
    const bool any = std::find(red_.begin(), red_.end(), true) != red_.end();
    const bool all = std::find(red_.begin(), red_.end(), false) == red_.end();
    ran_red_ = ran_red_ || all;
    lane_ = any && !all ? lane : none;
}

/// Compares the best of the turnings that had red with the best of the others.
void RedLightWatch::decide(const TownT& town,
                           const Eigen::Vector3d& p_rear,
                           double yaw,
                           double lead) {
    const LaneT& lane = town.lanes[lane_];
    const LanePoint end = point_at(lane, lane.length);
    const Eigen::Vector2d behind = (p_rear - end.position).head<2>();
    const bool is_before =
        behind.dot(ahead_of(end.yaw)) < 0 && std::abs(wrap_angle(yaw - end.yaw)) < around;
    if (lead > 0 && (is_before || behind.norm() < inside))
        return;
    double red = std::numeric_limits<double>::infinity();
    double free = red;
    for (std::size_t i = 0; i < red_.size(); ++i) {
        double& best = red_[i] ? red : free;
        best = std::min(best, misfit(town, lane.links[i], p_rear, yaw));
    }
    if (std::abs(red - free) < lead && behind.norm() <= turn_is_over)
        return;
    ran_red_ = ran_red_ || red < free;
    lane_ = none;
}

}  // namespace reprise::world
