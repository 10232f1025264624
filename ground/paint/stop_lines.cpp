#include "ground/paint/stop_lines.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"
#include "world/lanes/junctions.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::ground {

namespace {

constexpr double stop_line_width = 0.4;  ///< [m] along the lane
constexpr double gap = 0.4;              ///< [m] to the lane's end
constexpr double shortest_marked = 3.0;  ///< [m] shorter lanes carry no line
constexpr double tooth_length = 0.6;     ///< [m] along the lane
constexpr double tooth_width = 0.4;      ///< [m]
constexpr double tooth_period = 0.6;     ///< [m]

bool must_yield(const world::LaneT& lane) {
    return !lane.links.empty() &&
           std::all_of(lane.links.begin(), lane.links.end(), [](const world::Link& link) {
               return link.yields();
           });
}

/// Does a sign to give way stand beside the lane's end, for those who drive on it?
bool has_yield_sign(const world::TownT& town, const world::LaneT& lane) {
    constexpr double reach = 10;   // [m]
    constexpr double askew = 0.6;  // [rad]
    const world::Vec3& end = lane.centre.back();
    const double yaw = world::point_at(lane, lane.length).yaw;
    return std::any_of(town.props.begin(), town.props.end(), [&](const world::Prop& prop) {
        return prop.kind() == world::PropKind::yield_sign &&
               (world::to_eigen(prop.position()) - world::to_eigen(end)).norm() < reach &&
               std::abs(world::wrap_angle(prop.yaw() - yaw)) < askew;
    });
}

}  // namespace

StopLines::StopLines(const world::TownT& town)
    : town_(&town),
      has_stop_sign_(world::lanes_with_stop_sign(town)),
      has_priority_road_(town.junctions.size(), false) {
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving && lane.junction < has_priority_road_.size() &&
            !lane.links.empty() && !must_yield(lane))
            has_priority_road_[lane.junction] = true;
}

StopLines::Kind StopLines::kind_of(std::uint32_t index) const {
    const world::LaneT& lane = town_->lanes[index];
    // A left turn that gives way to oncoming traffic does not make a priority road stop.
    if (std::any_of(lane.links.begin(), lane.links.end(), [](const world::Link& link) {
            return link.signal() != world::none;
        }))
        return Kind::stop;
    if (!must_yield(lane))
        return Kind::none;
    if (has_stop_sign_[index])
        return Kind::stop;
    // A main road with a crossing gives way as well, to walkers: the sign tells who is meant.
    if (has_yield_sign(*town_, lane))
        return Kind::give_way;
    const bool is_minor =
        lane.junction < has_priority_road_.size() && has_priority_road_[lane.junction];
    return is_minor ? Kind::give_way : Kind::none;
}

void StopLines::paint(std::uint32_t index, const Line& centre, Paint& paint) const {
    const world::LaneT& lane = town_->lanes[index];
    const double length = length_of(centre);
    const Kind kind = kind_of(index);
    if (kind == Kind::none || length < shortest_marked)
        return;
    const double width = lane.width - 2 * line_width;
    const double end = length - gap;
    if (kind == Kind::stop) {
        paint.line(stretch(centre, end - stop_line_width, end), width);
        return;
    }
    const int teeth = std::max(1, static_cast<int>(width / tooth_period));
    for (int i = 0; i < teeth; ++i) {
        const double t = (i - (teeth - 1) / 2.0) * tooth_period;
        paint.shape(
            centre,
            {{end, t - tooth_width / 2}, {end, t + tooth_width / 2}, {end - tooth_length, t}});
    }
}

}  // namespace reprise::ground
