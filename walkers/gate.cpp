#include "walkers/gate.h"

#include <algorithm>
#include <cmath>

namespace reprise::walkers {

namespace {

constexpr double least_pace = 0.5;  // [m/s] to reckon with

bool is_free_at(const Conflict& conflict, const Pace& pace, const RoadTraffic& traffic) {
    const double speed = std::max(pace.speed, least_pace);
    const double near = conflict.at - conflict.half_width - pace.progress;
    const double far = conflict.at + conflict.half_width - pace.progress;
    const Stay stay{std::max(0.0, near / speed), far / speed};
    return traffic.is_free(conflict, stay, pace.trust, pace.on_road);
}

/// Or only past its mouth, on the sidewalk?
bool goes_over(const world::LaneT& crossing, const Gate& gate) {
    constexpr double least = 1;  // [m]
    return std::abs(world::project(crossing, gate.to).s - world::project(crossing, gate.from).s) >
           least;
}

/// Does one crossing end at this corner of the way, and another begin? Their ends reach over the
/// kerb, and meet there where the pavement is narrow.
bool is_next_crossing(const std::vector<WalkMap::Step>& way, std::size_t corner) {
    using ground::Surface;
    constexpr double least_leg = 1;         // [m]
    constexpr double cosine_of_bend = 0.7;  // 45 degrees
    if (way[corner - 1].surface != Surface::crossing || way[corner].surface != Surface::crossing)
        return false;
    const Eigen::Vector2d in = (way[corner].position - way[corner - 1].position).head<2>();
    const Eigen::Vector2d out = (way[corner + 1].position - way[corner].position).head<2>();
    return in.norm() > least_leg && out.norm() > least_leg &&
           in.dot(out) < cosine_of_bend * in.norm() * out.norm();
}

/// Lights of the crossings below a straight way.
void add_signals(const world::TownT& town,
                 const world::LaneMap& lanes,
                 const WalkerLights& lights,
                 Gate& gate) {
    for (const double share : {0.2, 0.5, 0.8}) {
        const Eigen::Vector3d place = gate.from + share * (gate.to - gate.from);
        for (const world::LaneMap::Found& found : lanes.walkable_at(place)) {
            const world::LaneT& crossing = town.lanes[found.lane];
            if (crossing.kind != world::LaneKind::crossing || !goes_over(crossing, gate))
                continue;
            for (const std::uint32_t signal : lights.of_crossing(found.lane))
                if (std::find(gate.signals.begin(), gate.signals.end(), signal) ==
                    gate.signals.end())
                    gate.signals.push_back(signal);
        }
    }
}

}  // namespace

Eigen::Vector2d Gate::direction() const {
    const double far = length();
    return far > 1e-6 ? Eigen::Vector2d((to - from).head<2>() / far) : Eigen::Vector2d(1, 0);
}

double Gate::progress(const Eigen::Vector3d& p_world) const {
    return (p_world - from).head<2>().dot(direction());
}

std::vector<Gate> gates_of(const std::vector<WalkMap::Step>& way,
                           const world::TownT& town,
                           const world::LaneMap& lanes,
                           const WalkerLights& lights,
                           const RoadTraffic& traffic) {
    using ground::Surface;
    std::vector<Gate> gates;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        if (way[i].surface == Surface::sidewalk)
            continue;
        Gate gate;
        gate.first = i;
        gate.from = way[i].position;
        gate.marked = true;
        for (; i + 1 < way.size() && way[i].surface != Surface::sidewalk; ++i) {
            if (i > gate.first && is_next_crossing(way, i))
                break;
            gate.marked = gate.marked && way[i].surface == Surface::crossing;
        }
        gate.last = i;
        gate.to = way[i].position;
        if (way[i].surface != Surface::sidewalk && i + 1 < way.size())
            --i;  // the next one begins here
        // Who cuts a crossing's corner over the road waits for its light as well.
        add_signals(town, lanes, lights, gate);
        gate.conflicts = traffic.conflicts(gate.from, gate.to);
        gates.push_back(std::move(gate));
    }
    return gates;
}

bool may_enter(const Gate& gate,
               const Pace& pace,
               const WalkerLights& lights,
               const RoadTraffic& traffic) {
    for (const std::uint32_t signal : gate.signals)
        if (!lights.is_open(signal))
            return false;
    return std::all_of(gate.conflicts.begin(), gate.conflicts.end(), [&](const Conflict& each) {
        return is_free_at(each, pace, traffic);
    });
}

bool must_hold(const Gate& gate, const Pace& pace, const RoadTraffic& traffic) {
    constexpr double braking = 4;  // [m/s^2] of somebody on foot
    const double about_to = std::max(0.5, pace.speed * pace.speed / (2 * braking) + 0.3);  // [m]
    return std::any_of(gate.conflicts.begin(), gate.conflicts.end(), [&](const Conflict& each) {
        const double left = each.at - each.half_width - pace.progress;
        return left > 0 && left < about_to && !is_free_at(each, pace, traffic);
    });
}

}  // namespace reprise::walkers
