#include "drivers/way/way.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "drivers/way/lane_lines.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/random.h"

namespace reprise::drivers {

namespace {

using world::LaneT;
using world::Link;

constexpr double speed_share = 0.95;   // of the limit that we aim for
constexpr double change_time = 3.5;    // [s] that a change of lanes takes
constexpr double between_changes = 5;  // [m]
constexpr double shortest_time = 2.3;  // [s] at this a change is felt with 4 m/s^2
constexpr double firm_braking = 2;     // [m/s^2] that the path's envelope of speeds counts on
// Who goes nowhere in particular leaves a lane that leads nowhere so long before its end.
constexpr double wander_time = 12;    // [s] at the lane's limit
constexpr double least_wander = 100;  // [m] for each change
constexpr double most_wander = 300;   // [m]

bool to_the_left(const LaneT& from, std::uint32_t to) {
    return from.left == to;
}

}  // namespace

Way::Way(const LaneGraph& graph, std::uint64_t seed, std::uint32_t actor)
    : graph_(&graph),
      itinerary_(graph),
      seed_(seed),
      actor_(actor) {}

void Way::restart(const std::vector<std::uint32_t>& lanes, const WayStart& start) {
    REPRISE_CHECK(!lanes.empty() && start.s <= start.car_s, "no lanes, or the car behind its path");
    path_.clear();
    pieces_.clear();
    lanes_.clear();
    gates_.clear();
    changes_.clear();
    itinerary_.restart(lanes.front(), std::span(lanes).subspan(1));
    next_lane_ = lanes.front();
    next_s_ = start.s;
    car_ahead_ = car_path_s_ = start.car_s - start.s;
    car_speed_ = start.speed;
    changes_from_ = car_ahead_ + start.change_room;
    ended_ = false;
    note_plan();
}

void Way::set_stops(std::vector<std::uint32_t> stops, double last_s) {
    itinerary_.set_stops(std::move(stops), last_s);
}

void Way::extend(double s, double ahead) {
    bool grown = false;
    while (!ended_ && path_.end() < s + ahead) {
        append_next_lane();
        grown = true;
    }
    if (!grown)
        return;
    path_.finish({});
    name_lanes();
    note_plan();
}

void Way::drop_before(double s, double kept) {
    if (!pieces_.empty() && pieces_.front().end < s) {
        std::erase_if(pieces_, [s](const PathPiece& piece) { return piece.end < s; });
        if (!pieces_.empty())
            itinerary_.pass(pieces_.front().lane);
        name_lanes();
    }
    constexpr double step = 20;
    const double end = s - kept;
    if (path_.empty() || end < path_.start() + step)
        return;
    path_.drop_before(end);
    std::erase_if(gates_, [end](const Gate& gate) { return gate.exit_s < end; });
    std::erase_if(changes_, [end](const LaneChange& change) { return change.end < end; });
    note_plan();
}

void Way::name_lanes() {
    lanes_.clear();
    for (const PathPiece& piece : pieces_)
        lanes_.push_back(piece.lane);
}

void Way::append_next_lane() {
    if (graph_->town().lanes[next_lane_].kind == world::LaneKind::internal)
        append_inside();
    else if (!follow_itinerary())
        wander();
}

/// Only at the very start: the driver begins inside a junction.
void Way::append_inside() {
    const std::uint32_t index = next_lane_;
    append_straight(index, next_s_);
    const Link link(graph_->exit(index), index, world::none, world::Turn::straight, false, 0);
    const std::vector<std::uint32_t> rest = graph_->inside(link);
    for (std::size_t i = 1; i < rest.size(); ++i)
        append_straight(rest[i], 0);
    next_lane_ = graph_->exit(index);
    next_s_ = car_ahead_ = 0;
    ended_ = next_lane_ == world::none;
    if (!ended_)
        itinerary_.enter(next_lane_);
}

/// One step towards the next lane of the itinerary. False: there is none.
bool Way::follow_itinerary() {
    const LaneT& lane = graph_->town().lanes[next_lane_];
    const std::optional<std::uint32_t> wanted = itinerary_.next({next_lane_, next_s_ + car_ahead_});
    if (!wanted)
        return false;
    std::optional<std::uint32_t> link;
    if (wanted == lane.left || wanted == lane.right) {
        const bool may = !itinerary_.keeps_lane() || itinerary_.next_is_given();
        const std::optional<ChangeRoom> room =
            may ? room_for_change(itinerary_.changes_on(next_lane_)) : std::nullopt;
        if (room) {
            append_change(*wanted, *room);
            return true;
        }
        link = itinerary_.go_another_way(next_lane_);
    } else {
        const auto found = std::find_if(lane.links.begin(), lane.links.end(), [&](const Link& to) {
            return to.to() == *wanted;
        });
        if (found != lane.links.end())
            link = static_cast<std::uint32_t>(found - lane.links.begin());
        else
            itinerary_.drop_plan();
    }
    if (link)
        append_junction(next_lane_, *link);
    return link.has_value();
}

/// The next choice of one who goes nowhere in particular. It stays on its lane for as long as that
/// leads anywhere.
void Way::wander() {
    const auto better = itinerary_.keeps_lane() ? std::nullopt : graph_->better_lane(next_lane_);
    if (better) {
        const LaneT& here = graph_->town().lanes[next_lane_];
        const double each = std::clamp(wander_time * here.speed_limit, least_wander, most_wander);
        const double earliest = here.length - better->changes * each - next_s_;
        if (const auto room = room_for_change({better->changes, std::nullopt}, earliest)) {
            append_change(better->neighbour, *room);
            return;
        }
    }
    const std::vector<std::uint32_t> choices = graph_->choices(next_lane_);
    ended_ = choices.empty();
    if (ended_)
        append_straight(next_lane_, next_s_);
    else
        append_junction(
            next_lane_,
            choices[world::draw_index(
                choices.size(), seed_, junctions_, world::Purpose::driver_route, actor_)]);
}

/// [m] from a place on next_lane_ to where all these changes must be done, for each of them.
double Way::share_of_room(double from, const Itinerary::Changes& changes) const {
    const LaneT& here = graph_->town().lanes[next_lane_];
    double share = (here.length - from) / changes.count;
    if (changes.goal) {
        const LaneT& there = graph_->town().lanes[changes.goal->lane];
        const double goal = world::beside(there, changes.goal->s, here);
        // Where it is too near, it is passed on its lane.
        const double before_goal = (goal - from) / changes.count;
        share = before_goal < shortest_change ? share : before_goal;
    }
    return share;
}

/// For the first of them, not before `earliest` [m] ahead of next_s_; none: the car could not do
/// it.
std::optional<Way::ChangeRoom> Way::room_for_change(const Itinerary::Changes& changes,
                                                    double earliest) const {
    const LaneT& here = graph_->town().lanes[next_lane_];
    // Nor before the last stop, where that lies on this lane.
    const double goal = itinerary_.goal_on(next_lane_).value_or(next_s_);
    const double wait = std::max({changes_from_ - path_.end(), goal - next_s_, earliest, 0.0});
    const double room = share_of_room(next_s_ + wait, changes);
    // As fast as it must still be there when it brakes from now on.
    const double ahead = path_.end() + wait - car_path_s_;
    const double speed =
        std::sqrt(std::max(car_speed_ * car_speed_ - 2 * firm_braking * ahead, 0.0));
    const double usual = std::clamp(change_time * here.speed_limit, 20.0, 60.0);
    if (room >= std::max(shortest_change, shortest_time * speed)) {
        const double length = std::min(usual, room);
        return ChangeRoom{wait, length, room - length};
    }
    // A lane that ends here leaves no choice.
    const double left = here.length - next_s_;
    if (!here.links.empty() || left < shortest_change / 2 || goal > next_s_)
        return std::nullopt;
    return ChangeRoom{0, std::min(left, usual), 0};
}

void Way::append_straight(std::uint32_t lane, double from) {
    const LaneT& here = graph_->town().lanes[lane];
    append_piece(lane, part_of(here, from, here.length), here.speed_limit);
}

void Way::append_piece(std::uint32_t lane, const std::vector<Eigen::Vector3d>& line, double limit) {
    const double start = path_.end();
    path_.append(line, limit * speed_share);
    if (!pieces_.empty() && pieces_.back().lane == lane)
        pieces_.back().end = path_.end();
    else
        pieces_.push_back({lane, start, path_.end()});
}

void Way::append_change(std::uint32_t to, const ChangeRoom& room) {
    const std::uint32_t lane = next_lane_;
    const LaneT& here = graph_->town().lanes[lane];
    const LaneT& there = graph_->town().lanes[to];
    const double begin = next_s_ + room.wait;
    const double length = room.length;
    if (room.wait > 0)
        append_piece(lane, part_of(here, next_s_, begin), here.speed_limit);
    const double start = path_.end();

    const std::vector<Eigen::Vector3d> line = change_line(here, there, begin, length);
    const std::size_t half = line.size() / 2;
    append_piece(lane,
                 {line.begin(), line.begin() + static_cast<std::ptrdiff_t>(half) + 1},
                 here.speed_limit);
    append_piece(
        to, {line.begin() + static_cast<std::ptrdiff_t>(half), line.end()}, there.speed_limit);
    changes_.push_back({start, path_.end(), lane, to, room.spare, to_the_left(here, to)});
    next_lane_ = to;
    next_s_ = world::project(there, world::point_at(here, begin + length).position).s;
    car_ahead_ = 0;
    changes_from_ = path_.end() + between_changes;
    itinerary_.enter(to);
}

void Way::append_junction(std::uint32_t lane, std::uint32_t link_index) {
    append_straight(lane, next_s_);
    const Link& link = graph_->town().lanes[lane].links[link_index];
    Gate gate;
    gate.s = path_.end();
    gate.serial = junctions_++;
    gate.signal = link.signal();
    gate.from = lane;
    gate.link = link_index;
    gate.to = link.to();
    gate.turn = link.turn();
    gate.yields = link.yields();
    gate.has_stop_sign = gate.yields && graph_->has_stop_sign(lane);
    for (const std::uint32_t internal : graph_->inside(link))
        append_straight(internal, 0);
    gate.exit_s = path_.end();
    gate.crossed = link.signal() != world::none || is_crossed(*graph_, lane, link);
    if (link.yields() || link.signal() != world::none)
        gate.conflicts = find_conflicts(*graph_, lane, link, gate.s);
    gates_.push_back(std::move(gate));
    next_lane_ = link.to();
    next_s_ = car_ahead_ = 0;
    changes_from_ = std::max(changes_from_, path_.end() + between_changes);
    itinerary_.enter(next_lane_);
}

std::vector<std::uint32_t> Way::lanes_to_come(double s) const {
    std::vector<std::uint32_t> lanes;
    for (const PathPiece& piece : pieces_)
        if (piece.end >= s &&
            (lanes.empty() || graph_->town().lanes[piece.lane].kind == world::LaneKind::driving))
            lanes.push_back(piece.lane);
    if (!ended_ && (lanes.empty() || lanes.back() != next_lane_))
        lanes.push_back(next_lane_);
    lanes.insert(lanes.end(), itinerary_.lanes().begin(), itinerary_.lanes().end());
    return lanes;
}

void Way::add_to(world::Hasher& hasher) const {
    hasher.add(plan_digest_);
    hasher.add(std::uint64_t{pieces_.size()});
    for (const PathPiece& piece : pieces_) {
        hasher.add(piece.lane);
        hasher.add(piece.start);
        hasher.add(piece.end);
    }
    itinerary_.add_to(hasher);
    hasher.add(next_lane_);
    for (const double number : {next_s_, car_ahead_, car_path_s_, car_speed_, changes_from_})
        hasher.add(number);
    hasher.add(junctions_);
    hasher.add(ended_);
}

/// The long part of the digest: 20 kB of path, which changes a few times a minute only. Conflict
/// points follow from their gate and the town.
void Way::note_plan() {
    world::Hasher hasher;
    path_.add_to(hasher);
    hasher.add(std::uint64_t{gates_.size()});
    for (const Gate& gate : gates_) {
        hasher.add(gate.s);
        hasher.add(gate.exit_s);
        for (const std::uint32_t number : {gate.serial, gate.signal, gate.from, gate.link, gate.to})
            hasher.add(number);
        hasher.add(gate.turn);
        hasher.add(gate.yields);
        hasher.add(std::uint64_t{gate.conflicts.size()});
    }
    hasher.add(std::uint64_t{changes_.size()});
    for (const LaneChange& change : changes_) {
        for (const double number : {change.start, change.end, change.spare})
            hasher.add(number);
        hasher.add(change.from);
        hasher.add(change.to);
        hasher.add(change.to_left);
    }
    plan_digest_ = hasher.digest64();
}

}  // namespace reprise::drivers
