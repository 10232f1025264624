#include "ground/mesh/slab_cutters.h"

#include <algorithm>
#include <limits>

#include "ground/mesh/ground.h"
#include "ground/mesh/ribbon.h"
#include "world/frames.h"
#include "world/town.h"
#include "world/units.h"

namespace reprise::ground {

namespace {

constexpr double bus_clearance = 1.6;  ///< [m] within junctions, where wide lanes fan out
constexpr double end_clearance =
    1.0;  ///< [m] around a line's ends: paths may start with a sharp turn
constexpr double cutter_length =
    5.0;                         ///< [m] at most, of those that climb: they have one height each
constexpr double touch = 0.005;  ///< [m] neighbours that merely touch do not cut

double mean_height(const std::vector<Eigen::Vector3d>& corners) {
    double sum = 0;
    for (const Eigen::Vector3d& p : corners)
        sum += p.z();
    return sum / static_cast<double>(corners.size());
}

void add(const std::vector<Eigen::Vector3d>& corners, std::vector<SlabCutter>& cutters) {
    const world::Loop loop = world::in_plan(corners);
    cutters.push_back({loop, world::box_around(loop), mean_height(corners), false});
}

void add(const Ribbon& ribbon, std::vector<SlabCutter>& cutters) {
    for (const auto& piece : ribbon.pieces)
        add(piece, cutters);
}

double half_width(const world::LaneT& lane) {
    return lane.kind == world::LaneKind::internal
               ? std::clamp(lane.width / 2, car_clearance, bus_clearance)
               : std::max(lane.width / 2, car_clearance) - touch;
}

/// In pieces of at most `length` metres.
void add_lane(const world::LaneT& lane, double length, std::vector<SlabCutter>& cutters) {
    const auto line = with_more_points(clean_line(lane.centre), length);
    add(make_ribbon(line, -half_width(lane), half_width(lane)), cutters);
    // Where a path sets off sideways from its lane, neither's ribbon covers the corner between
    // them.
    const auto longer = with_more_points(clean_line(lane.centre, end_clearance), length);
    add(make_ribbon(longer, -end_clearance, end_clearance), cutters);
}

/// The corners that end_clearance leaves on the outside of a bend from one lane into the next, on
/// both sides.
void add_bend(const world::LaneT& lane,
              const world::LaneT& next,
              std::vector<SlabCutter>& cutters) {
    const std::vector<Eigen::Vector3d> line = clean_line(lane.centre);
    const std::vector<Eigen::Vector3d> onward = clean_line(next.centre);
    const Ribbon end = make_ribbon(line, -half_width(lane), half_width(lane));
    const Ribbon start = make_ribbon(onward, -half_width(next), half_width(next));
    add({line.back(), end.left.back(), start.left.front()}, cutters);
    add({line.back(), end.right.back(), start.right.front()}, cutters);
}

}  // namespace

std::vector<SlabCutter> slab_cutters(const world::TownT& town) {
    std::vector<SlabCutter> cutters;
    // Within one world::level_spacing all is one level, and no piece need be short.
    const double length = town.high.z() - town.low.z() < world::level_spacing
                              ? std::numeric_limits<double>::infinity()
                              : cutter_length;
    for (const world::LaneT& lane : town.lanes) {
        if (lane.kind == world::LaneKind::crossing && lane.outline.size() >= 3) {
            const world::Loop loop = world::in_plan(lane.outline);
            cutters.push_back({loop, world::box_around(loop), lane.outline[0].z(), true});
        }
        if (!world::is_for_cars(lane))
            continue;
        add_lane(lane, length, cutters);
        for (const world::Link& link : lane.links) {
            const std::uint32_t next = link.via() != world::none ? link.via() : link.to();
            if (next < town.lanes.size() && is_for_cars(town.lanes[next]))
                add_bend(lane, town.lanes[next], cutters);
        }
    }
    return cutters;
}

}  // namespace reprise::ground
