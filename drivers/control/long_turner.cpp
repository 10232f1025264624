#include "drivers/control/long_turner.h"

#include <cmath>

#include "drivers/control/wide_turn.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::drivers {

namespace {

constexpr double beside = 9;         // [m] from the end of our lane to the start of theirs
constexpr double least_turn = 0.9;   // [rad] over the junction
constexpr double against_us = -0.6;  // cosine
constexpr double in_sight = 40;      // [m] from our line
constexpr int most_inside = 4;       // lanes of one way over a junction

struct Exit {
    std::uint32_t lane = world::none;
    double turn = 0;  ///< [rad] until there, to the left
};

/// Where a way over a junction leads to.
Exit exit_of(const world::TownT& town, std::uint32_t internal) {
    Exit exit;
    for (int i = 0; i < most_inside && !town.lanes[internal].links.empty(); ++i) {
        const world::LaneT& lane = town.lanes[internal];
        exit.turn += world::wrap_angle(world::point_at(lane, lane.length).yaw -
                                       world::point_at(lane, 0).yaw);
        exit.lane = lane.links.front().to();
        if (town.lanes[exit.lane].kind != world::LaneKind::internal)
            return exit;
        internal = exit.lane;
    }
    return {};
}

}  // namespace

bool turns_in_beside(const world::TickView& last,
                     const world::TownT& town,
                     const Gate& gate,
                     std::uint32_t self) {
    const world::LaneT& from = town.lanes[gate.from];
    const world::LanePoint line = world::point_at(from, from.length);
    const auto turns_in =
        [&](const world::VehicleModel& model, const world::Vec3& position, std::uint32_t lane) {
            if (!WideTurnPlan::is_needed(model) || lane >= town.lanes.size() ||
                town.lanes[lane].kind != world::LaneKind::internal ||
                std::hypot(position.x() - line.position.x(), position.y() - line.position.y()) >
                    in_sight)
                return false;
            const Exit exit = exit_of(town, lane);
            if (exit.lane == world::none || std::abs(exit.turn) < least_turn)
                return false;
            const world::LanePoint start = world::point_at(town.lanes[exit.lane], 0);
            return (start.position - line.position).norm() < beside &&
                   world::ahead_of(start.yaw).dot(world::ahead_of(line.yaw)) < against_us;
        };
    for (const world::CarState& car : last.cars())
        if (turns_in(world::vehicle_models()[car.model()], car.position(), car.lane()))
            return true;
    for (const world::VehicleState& other : last.vehicles()) {
        const world::Measurement* measured = world::find(last.measurements(), other.id());
        if (other.id() != self && measured != nullptr &&
            turns_in(world::vehicle_models()[other.model()], other.position(), measured->lane()))
            return true;
    }
    return false;
}

}  // namespace reprise::drivers
