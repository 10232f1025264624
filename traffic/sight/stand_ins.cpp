#include "traffic/sight/stand_ins.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double room_to_pull_out = 4;  // [m] between the stand-in and what it stands for
constexpr double half_car_width = 1;    // [m] what leaves that free on both sides blocks nobody
constexpr double one_row = 15;          // [m] from the begin of one thing to that of the next
constexpr double same_place = 0.5;      // [m]
constexpr double stands_since = 1;      // [s]

}  // namespace

/// The first of each row of things that block a lane.
void StandIns::find_wanted(std::span<const Obstruction> obstructions) {
    wanted_.clear();
    const Obstruction* row = nullptr;
    for (const Obstruction& one : obstructions) {
        const world::LaneT& lane = town_->lanes[one.lane];
        if (lane.kind != world::LaneKind::driving || (lane.left == none && lane.right == none) ||
            graph_->edge_of(one.lane) == none)
            continue;
        if (!one.lasts || one.left < -half_car_width || one.right > half_car_width)
            continue;
        const bool of_the_row =
            row != nullptr && row->lane == one.lane && one.begin - row->begin < one_row;
        row = &one;
        if (!of_the_row)
            wanted_.push_back({one.lane, one.id, one.begin, 0, ""});
    }
}

void StandIns::place(StandIn& one, const Cars& cars) {
    using libsumo::Vehicle;
    const world::LaneT& lane = town_->lanes[one.lane];
    const double scale = lane.sumo_length / lane.length;
    const double front = (one.begin - room_to_pull_out) * scale;
    const double rear = front - stand_in_length;
    if (rear < 0.1 || front > lane.sumo_length)
        return;
    const auto all = cars.all();
    if (std::any_of(all.begin(), all.end(), [&](const Car& car) {
            return car.lane == one.lane && car.lane_position > rear &&
                   car.lane_position - world::vehicle_models()[car.model].length < front;
        }))
        return;
    one.sumo = fmt::format("stand-in {}", added_++);
    libsumo::Route::add(one.sumo, graph_->names({graph_->edge_of(one.lane)}));
    Vehicle::add(one.sumo, one.sumo, stand_in_type(), "now");
    Vehicle::moveTo(one.sumo, lane.name, front);
    Vehicle::setSpeedMode(one.sumo, 0);
    Vehicle::setLaneChangeMode(one.sumo, 0);
    // No stop of SUMO's: that would move scripted cars, too, which change lanes as told only.
    Vehicle::setSpeed(one.sumo, 0);
}

void StandIns::advance(std::span<const Obstruction> obstructions,
                       const Cars& cars,
                       std::uint64_t tick) {
    if (obstructions.empty() && all_.empty())
        return;
    find_wanted(obstructions);
    for (StandIn& one : wanted_) {
        one.since = tick;
        for (StandIn& before : all_)
            if (before.lane == one.lane && before.id == one.id &&
                std::abs(before.begin - one.begin) < same_place) {
                one = std::move(before);
                before.sumo.clear();
                before.lane = none;
                break;
            }
    }
    for (const StandIn& gone : all_)
        if (!gone.sumo.empty())
            libsumo::Vehicle::remove(gone.sumo);
    std::swap(all_, wanted_);
    const auto patience = static_cast<std::uint64_t>(stands_since / step_);
    for (StandIn& one : all_)
        if (one.sumo.empty() && tick >= one.since + patience)
            place(one, cars);
}

void StandIns::add_to(world::Hasher& hasher) const {
    for (const StandIn& one : all_) {
        hasher.add(one.lane);
        hasher.add(one.id);
        hasher.add(one.begin);
        hasher.add(one.since);
        hasher.add(!one.sumo.empty());
    }
    if (added_ > 0)
        hasher.add(added_);
}

}  // namespace reprise::traffic
