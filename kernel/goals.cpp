#include "kernel/goals.h"

#include <algorithm>
#include <cmath>

#include "world/models/catalogue.h"

namespace reprise::kernel {

std::optional<world::LanePlace> Goals::place_of(const world::Measurement* measured) const {
    if (measured == nullptr || measured->lane() >= town_->lanes.size())
        return std::nullopt;
    return world::LanePlace{measured->lane(), measured->lane_s()};
}

void Goals::hear(const world::CommandT& command,
                 const world::TickView& last,
                 const world::TickDraft& next) {
    if (command.kind == world::CommandKind::change_lane)
        sent_[command.actor].keeps_lane =
            command.lanes.size() == 1 && command.lanes[0] == world::none;
    if (command.kind != world::CommandKind::set_route)
        return;
    const world::Measurement* seen = world::find(last.measurements(), command.actor);
    if (seen == nullptr)  // it has just been spawned
        seen =
            world::find(std::span<const world::Measurement>(next.tick.measurements), command.actor);
    if (seen == nullptr)
        return;  // without mass
    Sent& sent = sent_[command.actor];
    sent.progress.reset();
    const auto from = place_of(seen);
    const auto is_way = [&](std::uint32_t lane) {
        return lane < town_->lanes.size() && world::is_for_cars(town_->lanes[lane]);
    };
    if (!from || command.lanes.empty() ||
        !std::all_of(command.lanes.begin(), command.lanes.end(), is_way))
        return;
    const auto changes =
        sent.keeps_lane ? world::LaneChanges::forbidden : world::LaneChanges::allowed;
    if (auto route =
            world::plan_over(world::Planner(*town_, changes), *from, command.lanes, command.s)) {
        sent.length = route->length;
        sent.progress.emplace(std::move(*route));
    }
}

void Goals::note(const world::TickView& last, world::TickDraft& next) {
    for (const world::CommandT& command : next.tick.commands)
        hear(command, last, next);
    for (std::size_t i = 0; i < next.tick.vehicles.size() && !sent_.empty(); ++i) {
        const world::VehicleState& vehicle = next.tick.vehicles[i];
        world::Measurement& measured = next.tick.measurements[i];
        const auto found = sent_.find(vehicle.id());
        if (found == sent_.end() || !found->second.progress)
            continue;
        Sent& sent = found->second;
        const world::VehicleState* before = world::find(last.vehicles(), vehicle.id());
        const double driven =
            before == nullptr ? 0 : std::abs(vehicle.odometer() - before->odometer());
        const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
        const double front = model.length - model.rear_overhang;
        sent.progress->drive_on(*town_, place_of(&measured), driven, front);
        const double share = sent.progress->share();
        measured.mutate_goal_distance(
            share >= 1 ? 0 : std::max(0.0, sent.length * (1 - share) - front));
    }
    std::erase_if(sent_, [&](const auto& one) {
        return world::find(std::span<const world::VehicleState>(next.tick.vehicles), one.first) ==
               nullptr;
    });
}

}  // namespace reprise::kernel
