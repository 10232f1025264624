#include "remote/guide.h"

#include "world/lanes/make_route.h"
#include "world/lanes/planner.h"

namespace reprise::remote {

namespace {

Turning turning_of(world::RouteCommand command) {
    switch (command) {
        case world::RouteCommand::straight:
            return Turning::straight;
        case world::RouteCommand::left:
            return Turning::left;
        case world::RouteCommand::right:
            return Turning::right;
        case world::RouteCommand::follow_lane:
        case world::RouteCommand::reach_goal:
            break;
    }
    return Turning::follow_lane;
}

const world::Measurement* measured(const world::Tick& tick, std::uint32_t actor) {
    if (tick.measurements() == nullptr)
        return nullptr;
    for (const world::Measurement* one : *tick.measurements())
        if (one->actor() == actor)
            return one;
    return nullptr;
}

}  // namespace

/// The scenario's last word about where to go.
void Guide::hear(const world::Tick& tick) {
    if (tick.commands() == nullptr)
        return;
    for (const world::Command* command : *tick.commands()) {
        if (command->kind() != world::CommandKind::set_route || command->actor() != actor_ ||
            command->lanes() == nullptr)
            continue;
        stops_.assign(command->lanes()->begin(), command->lanes()->end());
        goal_s_ = command->s();
        passed_ = 0;
        route_.reset();
        planned_on_ = world::none;
    }
}

/// What lies behind a stop that was passed is no part of the way any more.
void Guide::pass_stops(std::uint32_t lane) {
    while (passed_ + 1 < stops_.size() &&
           town_->lanes[stops_[passed_]].edge == town_->lanes[lane].edge) {
        ++passed_;
        route_.reset();
        planned_on_ = world::none;
    }
}

std::optional<world::CommandT> Guide::route_left() const {
    if (stops_.empty())
        return std::nullopt;
    world::CommandT command;
    command.kind = world::CommandKind::set_route;
    command.actor = actor_;
    command.s = goal_s_;
    command.lanes.assign(stops_.begin() + static_cast<std::ptrdiff_t>(passed_), stops_.end());
    return command;
}

/// Through the stops that are left, as one way.
std::optional<world::Route> Guide::plan(world::LanePlace from) const {
    const world::Planner planner(*town_);
    std::vector<std::uint32_t> lanes;
    world::LanePlace here = from;
    for (std::size_t i = passed_; i < stops_.size(); ++i) {
        const bool is_goal = i + 1 == stops_.size();
        const world::LanePlace stop{stops_[i], is_goal ? goal_s_ : 0};
        auto leg = planner.plan(here, stop);
        if (!leg)
            return std::nullopt;
        for (const world::Route::Piece& piece : leg->pieces)
            if (lanes.empty() || lanes.back() != piece.lane)
                lanes.push_back(piece.lane);
        if (is_goal && i == passed_)
            return leg;
        here = stop;
    }
    return world::make_route(*town_, lanes, from.s, goal_s_);
}

Guidance Guide::look(const world::Tick& tick) {
    hear(tick);
    const world::Measurement* const self = measured(tick, actor_);
    if (stops_.empty() || self == nullptr || self->lane() == world::none)
        return last_;  // off every lane: as it was
    const world::LanePlace here{self->lane(), self->lane_s()};
    pass_stops(here.lane);
    std::optional<double> left;
    if (route_)
        left = world::distance_to_goal(*town_, *route_, here);
    if (!left && planned_on_ != here.lane) {
        planned_on_ = here.lane;
        if (auto route = plan(here)) {
            route_ = std::move(route);
            left = route_->length;
        }
    }
    if (left)
        last_ = {turning_of(world::command_at(*route_, route_->length - *left)), *left};
    return last_;
}

}  // namespace reprise::remote
