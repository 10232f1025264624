#include "drivers/way/itinerary.h"

#include <utility>

namespace reprise::drivers {

void Itinerary::set_stops(std::vector<std::uint32_t> stops, double last_s) {
    stops_ = std::move(stops);
    last_s_ = last_s;
    entered_ = 0;
    drop_plan();
}

void Itinerary::keep_lane(bool keep) {
    changes_ = keep ? world::LaneChanges::forbidden : world::LaneChanges::allowed;
}

void Itinerary::drop_plan() {
    lanes_.clear();
    given_ = 0;
}

/// The last stop may lie behind us on this very lane, any other one is passed.
void Itinerary::restart(std::uint32_t lane, std::span<const std::uint32_t> lanes) {
    lanes_.assign(lanes.begin(), lanes.end());
    given_ = lanes.size();
    entered_ = 0;
    if (stops_.size() > 1)
        pass(lane);
}

std::optional<std::uint32_t> Itinerary::next(world::LanePlace here) {
    if (lanes_.empty() && !to_come().empty()) {
        const Plan plan = graph_->plan(here, to_come(), last_s_, changes_);
        lanes_.assign(plan.lanes.begin(), plan.lanes.end());
        if (plan.unreachable != world::none)
            give_up();
        else if (lanes_.empty())
            entered_ = stops_.size();  // all of them lie ahead on this lane
    }
    if (lanes_.empty())
        return std::nullopt;
    return lanes_.front();
}

void Itinerary::enter(std::uint32_t lane) {
    if (!lanes_.empty() && lanes_.front() == lane) {
        lanes_.pop_front();
        given_ -= given_ > 0 ? 1 : 0;
    }
    if (entered_ < stops_.size() && stops_[entered_] == lane)
        ++entered_;
}

void Itinerary::pass(std::uint32_t lane) {
    if (stops_.empty() || stops_.front() != lane)
        return;
    stops_.erase(stops_.begin());
    entered_ -= entered_ > 0 ? 1 : 0;
}

std::optional<std::uint32_t> Itinerary::go_another_way(std::uint32_t lane) {
    drop_plan();
    if (to_come().empty())
        return std::nullopt;
    const std::optional<Detour> detour = graph_->detour(lane, to_come(), last_s_, changes_);
    if (!detour) {
        give_up();
        return std::nullopt;
    }
    lanes_.assign(detour->plan.lanes.begin(), detour->plan.lanes.end());
    lanes_.push_front(graph_->town().lanes[lane].links[detour->link].to());
    return detour->link;
}

Itinerary::Changes Itinerary::changes_on(std::uint32_t lane) const {
    Changes changes;
    for (const std::uint32_t next : lanes_) {
        const world::LaneT& here = graph_->town().lanes[lane];
        if (next != here.left && next != here.right)
            break;
        lane = next;
        ++changes.count;
    }
    if (to_come().size() == 1 && to_come().front() == lane)
        changes.goal = world::LanePlace{lane, last_s_};
    return changes;
}

std::optional<double> Itinerary::goal_on(std::uint32_t lane) const {
    if (stops_.empty() || !to_come().empty() || stops_.back() != lane)
        return std::nullopt;
    return last_s_;
}

void Itinerary::give_up() {
    stops_.resize(entered_);
    drop_plan();
}

void Itinerary::add_to(world::Hasher& hasher) const {
    hasher.add(std::uint64_t{lanes_.size()});
    for (const std::uint32_t lane : lanes_)
        hasher.add(lane);
    hasher.add(std::uint64_t{stops_.size()});
    for (const std::uint32_t lane : stops_)
        hasher.add(lane);
    hasher.add(std::uint64_t{entered_});
    hasher.add(last_s_);
    if (keeps_lane())
        hasher.add(std::uint64_t{given_});
}

}  // namespace reprise::drivers
