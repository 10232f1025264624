#include <array>
#include <set>
#include <utility>

#include "render/readings/readings.h"
#include "world/check.h"
#include "world/models/actors.h"

namespace reprise::render {

namespace {

enum Border : int { between_lanes, between_directions, edge };

using Corners = std::array<Eigen::Vector3d, 4>;

std::optional<Corners> corners_of(const world::TickView& tick, std::uint32_t actor) {
    const auto pose = world::find_pose(tick, actor);
    const auto extent = world::find_extent(tick, actor);
    if (!pose || !extent)
        return std::nullopt;
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = *pose * Eigen::Vector3d(i < 2 ? extent->front : extent->rear,
                                             i % 2 == 0 ? extent->half_width : -extent->half_width,
                                             0);
    return corners;
}

/// Whether a way from one place to the other leads across a line beside the lane; not around its
/// ends.
bool crosses(const world::LaneProjection& from, const world::LaneProjection& to, double t) {
    return (from.t < t) != (to.t < t);
}

bool is_along(const world::LaneT& lane, const world::LaneProjection& at) {
    return at.s > 0 && at.s < lane.length && at.distance < lane.width + 3;
}

bool is_driving(const world::TownT& town, std::uint32_t lane) {
    return lane != world::none && town.lanes[lane].kind == world::LaneKind::driving;
}

}  // namespace

std::vector<world::Reading> lane_invasion_readings(const world::TickView& last,
                                                   const world::TickView& tick,
                                                   const world::SensorSpec& spec,
                                                   const world::TownT& town,
                                                   const world::LaneMap& lanes) {
    const auto before = corners_of(last, spec.actor);
    const auto now = corners_of(tick, spec.actor);
    if (!now)
        throw world::Error("sensor '" + spec.name + "': there is no actor " +
                           std::to_string(spec.actor) + " at tick " + std::to_string(tick.index()));
    std::set<std::pair<std::uint32_t, int>> crossed;
    for (std::size_t i = 0; before && i < now->size(); ++i) {
        for (const std::uint32_t index : lanes.near((*now)[i], 3)) {
            const world::LaneT& lane = town.lanes[index];
            if (lane.kind != world::LaneKind::driving)
                continue;
            const world::LaneProjection from = world::project(lane, (*before)[i]);
            const world::LaneProjection to = world::project(lane, (*now)[i]);
            if (!is_along(lane, from) || !is_along(lane, to))
                continue;
            // Of two neighbours one owns the border between them.
            if (crosses(from, to, lane.width / 2)) {
                if (is_driving(town, lane.left))
                    crossed.emplace(index, between_lanes);
                else if (lane.opposite == world::none)
                    crossed.emplace(index, edge);
                else
                    crossed.emplace(std::min(index, lane.opposite), between_directions);
            }
            if (crosses(from, to, -lane.width / 2) && !is_driving(town, lane.right))
                crossed.emplace(index, edge);
        }
    }
    std::vector<world::Reading> found;
    for (const auto& [lane, border] : crossed)
        found.push_back({static_cast<double>(lane), static_cast<double>(border)});
    return found;
}

}  // namespace reprise::render
