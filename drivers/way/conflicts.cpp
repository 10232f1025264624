#include "drivers/way/conflicts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::drivers {

namespace {

using world::LaneT;
using world::Link;

/// The internal lanes of a link as one line in plan, with the distance at every corner.
struct Line {
    std::vector<Eigen::Vector2d> points;
    std::vector<double> s;
};

Line line_of(const LaneGraph& graph, const std::vector<std::uint32_t>& lanes) {
    Line line;
    for (const std::uint32_t lane : lanes) {
        for (const world::Vec3& corner : graph.town().lanes[lane].centre) {
            const Eigen::Vector2d point(corner.x(), corner.y());
            const double step = line.points.empty() ? 0 : (point - line.points.back()).norm();
            line.s.push_back(line.points.empty() ? 0 : line.s.back() + step);
            line.points.push_back(point);
        }
    }
    return line;
}

struct Meeting {
    double ours = 0;
    double theirs = 0;
};

/// Where the first line first crosses the second.
std::optional<Meeting> crossing(const Line& ours, const Line& theirs) {
    for (std::size_t i = 0; i + 1 < ours.points.size(); ++i) {
        const Eigen::Vector2d our_step = ours.points[i + 1] - ours.points[i];
        for (std::size_t k = 0; k + 1 < theirs.points.size(); ++k) {
            const Eigen::Vector2d their_step = theirs.points[k + 1] - theirs.points[k];
            const double area = world::cross(our_step, their_step);
            if (std::abs(area) < 1e-9)
                continue;
            const Eigen::Vector2d between = theirs.points[k] - ours.points[i];
            const double u = world::cross(between, their_step) / area;
            const double v = world::cross(between, our_step) / area;
            if (u >= 0 && u <= 1 && v >= 0 && v <= 1)
                return Meeting{ours.s[i] + u * our_step.norm(),
                               theirs.s[k] + v * their_step.norm()};
        }
    }
    return std::nullopt;
}

/// [m/s] at which a driver takes it, by its mean radius; infinite where it leads straight on.
double pace_on(const Line& line) {
    constexpr double sideways = 2;  // [m/s^2] that drivers like
    constexpr double least = 2.5;   // [m/s]
    constexpr double bends = 0.35;  // [rad] all of it
    const std::size_t last = line.points.size() - 1;
    double turned = 0;
    for (std::size_t i = 1; i < last; ++i) {
        const Eigen::Vector2d before = line.points[i] - line.points[i - 1];
        const Eigen::Vector2d behind = line.points[i + 1] - line.points[i];
        turned += std::atan2(world::cross(before, behind), before.dot(behind));
    }
    turned = std::abs(turned);
    return turned < bends ? world::infinity
                          : std::max(std::sqrt(sideways * line.s.back() / turned), least);
}

double end_yaw(const LaneT& lane) {
    return world::point_at(lane, lane.length).yaw;
}

void add_conflict(const LaneGraph& graph,
                  std::uint32_t lane,
                  const Link& link,
                  const std::vector<std::uint32_t>& inside,
                  const Meeting& meeting,
                  const ConflictPoint& pattern,
                  std::vector<ConflictPoint>& conflicts) {
    ConflictPoint conflict = pattern;
    conflict.signal = link.signal();
    conflict.turn = link.turn();
    conflict.yields = link.yields();
    // Seen from the lane that leads to the junction ...
    conflict.lane = lane;
    conflict.to_conflict = graph.town().lanes[lane].length + meeting.theirs;
    conflicts.push_back(conflict);
    // ... and from every internal lane up to the place.
    conflict.inside = true;
    double start = 0;
    for (const std::uint32_t internal : inside) {
        conflict.lane = internal;
        conflict.to_conflict = meeting.theirs - start;
        conflicts.push_back(conflict);
        start += graph.town().lanes[internal].length;
        if (start > meeting.theirs)
            break;
    }
}

}  // namespace

std::vector<ConflictPoint> find_conflicts(const LaneGraph& graph,
                                          std::uint32_t lane,
                                          const world::Link& link,
                                          double gate_s) {
    std::vector<ConflictPoint> conflicts;
    const LaneT& from = graph.town().lanes[lane];
    const Line ours = line_of(graph, graph.inside(link));
    if (ours.points.empty())
        return conflicts;
    for (const std::uint32_t other : graph.incoming(from.junction)) {
        const LaneT& other_lane = graph.town().lanes[other];
        if (other == lane || other_lane.edge == from.edge)
            continue;
        // How much we would have to turn to drive as they do.
        const double turn = world::wrap_angle(end_yaw(other_lane) - end_yaw(from));
        ConflictPoint pattern;
        pattern.from_right = turn > std::numbers::pi / 6 && turn < std::numbers::pi * 5 / 6;
        pattern.oncoming = std::abs(turn) >= std::numbers::pi * 5 / 6;
        for (const Link& other_link : other_lane.links) {
            const std::vector<std::uint32_t> inside = graph.inside(other_link);
            const Line theirs = line_of(graph, inside);
            if (theirs.points.empty())
                continue;
            std::optional<Meeting> meeting = crossing(ours, theirs);
            if (!meeting && other_link.to() == link.to())
                meeting = Meeting{ours.s.back(), theirs.s.back()};
            if (!meeting)
                continue;
            pattern.our_s = gate_s + meeting->ours;
            pattern.pace = pace_on(theirs);
            add_conflict(graph, other, other_link, inside, *meeting, pattern, conflicts);
        }
    }
    return conflicts;
}

bool is_crossed(const LaneGraph& graph, std::uint32_t lane, const world::Link& link) {
    const LaneT& from = graph.town().lanes[lane];
    const Line ours = line_of(graph, graph.inside(link));
    if (ours.points.empty() || graph.has_walkers_crossing(from.junction))
        return true;
    for (const std::uint32_t other : graph.incoming(from.junction)) {
        const LaneT& other_lane = graph.town().lanes[other];
        if (other_lane.edge == from.edge)
            continue;
        for (const Link& other_link : other_lane.links)
            if (other_link.to() != link.to() &&
                crossing(ours, line_of(graph, graph.inside(other_link))))
                return true;
    }
    return false;
}

}  // namespace reprise::drivers
