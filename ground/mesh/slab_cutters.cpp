#include "ground/mesh/slab_cutters.h"

#include <algorithm>
#include <limits>

#include "ground/mesh/ribbon.h"
#include "ground/mesh/slabs.h"
#include "world/frames.h"
#include "world/town.h"

namespace reprise::world {

namespace {

constexpr double bus_clearance = 1.6;  ///< [m] within junctions, where wide lanes fan out
constexpr double end_clearance =
    1.0;                        ///< [m] around a line's ends: paths may start with a sharp turn
constexpr double storey = 2.5;  ///< [m] lanes that differ by less are on one level
constexpr double cutter_length =
    5.0;                         ///< [m] at most, of those that climb: they have one height each
constexpr double touch = 0.005;  ///< [m] neighbours that merely touch do not cut

Loop flat_loop(const std::vector<Eigen::Vector3d>& corners) {
    Loop loop;
    for (const Eigen::Vector3d& p : corners)
        loop.push_back(p.head<2>());
    return loop;
}

double mean_height(const std::vector<Eigen::Vector3d>& corners) {
    double sum = 0;
    for (const Eigen::Vector3d& p : corners)
        sum += p.z();
    return sum / static_cast<double>(corners.size());
}

void add(const std::vector<Eigen::Vector3d>& corners, std::vector<SlabCutter>& cutters) {
    const Loop loop = flat_loop(corners);
    cutters.push_back({loop, box_around(loop), mean_height(corners), false});
}

void add(const Ribbon& ribbon, std::vector<SlabCutter>& cutters) {
    for (const auto& piece : ribbon.pieces)
        add(piece, cutters);
}

double half_width(const LaneT& lane) {
    return lane.kind == LaneKind::internal
               ? std::clamp(lane.width / 2, car_clearance, bus_clearance)
               : std::max(lane.width / 2, car_clearance) - touch;
}

/// In pieces of at most `length` metres.
void add_lane(const LaneT& lane, double length, std::vector<SlabCutter>& cutters) {
    const auto line = with_more_points(clean_line(lane.centre), length);
    add(make_ribbon(line, -half_width(lane), half_width(lane)), cutters);
    // Where a path sets off sideways from its lane, neither's ribbon covers the corner between
    // them.
    const auto longer = with_more_points(clean_line(lane.centre, end_clearance), length);
    add(make_ribbon(longer, -end_clearance, end_clearance), cutters);
}

/// The corners that end_clearance leaves on the outside of a bend from one lane into the next, on
/// both sides.
void add_bend(const LaneT& lane, const LaneT& next, std::vector<SlabCutter>& cutters) {
    const std::vector<Eigen::Vector3d> line = clean_line(lane.centre);
    const std::vector<Eigen::Vector3d> onward = clean_line(next.centre);
    const Ribbon end = make_ribbon(line, -half_width(lane), half_width(lane));
    const Ribbon start = make_ribbon(onward, -half_width(next), half_width(next));
    add({line.back(), end.left.back(), start.left.front()}, cutters);
    add({line.back(), end.right.back(), start.right.front()}, cutters);
}

}  // namespace

std::vector<SlabCutter> slab_cutters(const TownT& town) {
    std::vector<SlabCutter> cutters;
    // Within one storey all is one level, and no piece need be short.
    const double length = town.high.z() - town.low.z() < storey
                              ? std::numeric_limits<double>::infinity()
                              : cutter_length;
    for (const LaneT& lane : town.lanes) {
        if (lane.kind == LaneKind::crossing && lane.outline.size() >= 3) {
            const Loop loop = in_plan(lane.outline);
            cutters.push_back({loop, box_around(loop), lane.outline[0].z(), true});
        }
        if (!is_for_cars(lane))
            continue;
        add_lane(lane, length, cutters);
        for (const Link& link : lane.links) {
            const std::uint32_t next = link.via() != none ? link.via() : link.to();
            if (next < town.lanes.size() && is_for_cars(town.lanes[next]))
                add_bend(lane, town.lanes[next], cutters);
        }
    }
    return cutters;
}

}  // namespace reprise::world
