#include "kernel/blockages.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "kernel/nearest_ahead.h"
#include "world/blockage.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

constexpr double queue_reach = 15;  // [m] who is farther ahead is no reason to stand

/// A walker in the corridor of the vehicle's width and half a metre to both sides; 0: none.
std::uint32_t walker_ahead(const world::VehicleState& vehicle, const world::TickDraft& next) {
    const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
    const double front = model.length - model.rear_overhang;
    const Eigen::Isometry3d pose_vehicle_world =
        world::pose(vehicle.position(), vehicle.orientation()).inverse();
    double nearest = queue_reach;
    std::uint32_t found = 0;
    for (const world::WalkerState& walker : next.traffic.walkers) {
        const Eigen::Vector3d p_vehicle = pose_vehicle_world * world::to_eigen(walker.position());
        const double gap = p_vehicle.x() - front;
        if (gap < -0.5 || gap >= nearest || std::abs(p_vehicle.y()) > model.width / 2 + 0.5)
            continue;
        nearest = gap;
        found = walker.id();
    }
    return found;
}

/// Is this the lane of a signal that is red, and its end near?
bool is_at_red(const world::TownT& town,
               const world::Measurement& measured,
               const world::TickDraft& next) {
    const world::LaneT& lane = town.lanes[measured.lane()];
    if (lane.length - measured.lane_s() > queue_reach)
        return false;
    return std::any_of(lane.links.begin(), lane.links.end(), [&](const world::Link& link) {
        return link.signal() < next.tick.signals.size() &&
               (next.tick.signals[link.signal()] == world::SignalColor::red ||
                next.tick.signals[link.signal()] == world::SignalColor::red_yellow);
    });
}

world::EventT blocked_event(const world::TownT& town,
                            std::uint64_t step_ns,
                            const world::VehicleState& vehicle,
                            const world::Measurement& measured,
                            const world::TickDraft& next) {
    world::EventT event;
    event.kind = world::EventKind::blocked;
    event.actor = vehicle.id();
    event.position = vehicle.position();
    event.value = world::seconds(next.tick.index - measured.halted_ticks(), step_ns);
    const bool on_a_lane = measured.lane() != world::none;
    event.text = fmt::format("since {:.2f} s {}",
                             event.value,
                             on_a_lane ? "on " + town.lanes[measured.lane()].name : "off the road");
    if (const Ahead ahead = nearest_ahead(vehicle, next); ahead.gap < queue_reach) {
        event.other = ahead.actor;
        event.detail = fmt::format("vehicle {} is {:.1f} m ahead", ahead.actor, ahead.gap);
    } else if (const std::uint32_t walker = walker_ahead(vehicle, next)) {
        event.other = walker;
        event.detail = fmt::format("walker {} is ahead", walker);
    } else if (on_a_lane && is_at_red(town, measured, next)) {
        event.detail = "the signal is red";
    }
    return event;
}

}  // namespace

void note_blockages(const world::TownT& town,
                    std::uint64_t step_ns,
                    const UnderWay& is_under_way,
                    const world::TickView& last,
                    world::TickDraft& next) {
    for (world::Measurement& measured : next.tick.measurements) {
        const world::VehicleState* vehicle = world::find(next.tick.vehicles, measured.actor());
        if (std::abs(measured.speed()) >= world::halted_speed || !is_under_way(*vehicle))
            continue;
        const world::Measurement* before = world::find(last.measurements(), measured.actor());
        measured.mutate_halted_ticks(before == nullptr ? 1 : before->halted_ticks() + 1);
        const bool was_blocked = before != nullptr && world::is_blocked(*before, step_ns);
        if (!was_blocked && world::is_blocked(measured, step_ns))
            next.tick.events.push_back(blocked_event(town, step_ns, *vehicle, measured, next));
    }
}

}  // namespace reprise::kernel
