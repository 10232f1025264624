#include "kernel/way.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "world/frames.h"
#include "world/random.h"

namespace reprise::kernel {

namespace {

using world::LaneT;
using world::Link;

constexpr double speed_share = 0.95;  // of the limit that we aim for
constexpr double change_time = 3.5;   // [s] that a change of lanes takes

/// The centre line between two places.
std::vector<Eigen::Vector3d> part_of(const LaneT& lane, double from, double to) {
    std::vector<Eigen::Vector3d> line{world::point_at(lane, from).position};
    double s = 0;
    for (std::size_t i = 0; i < lane.centre.size(); ++i) {
        const Eigen::Vector3d point = world::to_eigen(lane.centre[i]);
        if (i > 0)
            s += (point - world::to_eigen(lane.centre[i - 1])).norm();
        if (s > from + 1e-6 && s < to - 1e-6)
            line.push_back(point);
    }
    line.push_back(world::point_at(lane, to).position);
    return line;
}

bool to_the_left(const LaneT& from, std::uint32_t to) {
    return from.left == to;
}

}  // namespace

Way::Way(const LaneGraph& graph, std::uint64_t seed, std::uint32_t actor)
    : graph_(&graph),
      seed_(seed),
      actor_(actor) {}

void Way::restart(std::uint32_t lane,
                  double s,
                  std::vector<std::uint32_t> route,
                  double change_after) {
    path_.clear();
    pieces_.clear();
    lanes_.clear();
    gates_.clear();
    changes_.clear();
    route_.assign(route.begin(), route.end());
    if (!route_.empty() && route_.front() == lane)
        route_.pop_front();
    next_lane_ = lane;
    next_s_ = s;
    change_after_ = change_after;
    ended_ = false;
    note_plan();
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
    const std::uint32_t index = next_lane_;
    const LaneT& lane = graph_->town().lanes[index];
    if (lane.kind == world::LaneKind::internal) {
        // Only at the very start: the driver begins inside a junction.
        append_straight(index, next_s_);
        const Link link(graph_->exit(index), index, world::none, world::Turn::straight, false, 0);
        const std::vector<std::uint32_t> rest = graph_->inside(link);
        for (std::size_t i = 1; i < rest.size(); ++i)
            append_straight(rest[i], 0);
        next_lane_ = graph_->exit(index);
        next_s_ = 0;
        if (!route_.empty() && route_.front() == next_lane_)
            route_.pop_front();
        ended_ = next_lane_ == world::none;
        return;
    }

    // The route says where to go; without one, or off it, we wander.
    if (!route_.empty()) {
        const std::uint32_t wanted = route_.front();
        if (wanted == lane.left || wanted == lane.right) {
            route_.pop_front();
            append_change(index, next_s_, wanted);
            return;
        }
        for (std::uint32_t i = 0; i < lane.links.size(); ++i) {
            if (lane.links[i].to() != wanted)
                continue;
            route_.pop_front();
            append_straight(index, next_s_);
            append_junction(index, i);
            return;
        }
        route_.clear();
    }
    const std::vector<std::uint32_t> choices = graph_->choices(index);
    const std::uint32_t neighbour = graph_->better_neighbour(index);
    if (neighbour != world::none) {
        append_change(index, next_s_, neighbour);
    } else if (choices.empty()) {
        append_straight(index, next_s_);
        ended_ = true;
    } else {
        const std::uint64_t chosen = world::draw_index(
            choices.size(), seed_, junctions_, world::Purpose::driver_route, actor_);
        append_straight(index, next_s_);
        append_junction(index, choices[chosen]);
    }
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

void Way::append_change(std::uint32_t lane, double from, std::uint32_t to) {
    const LaneT& here = graph_->town().lanes[lane];
    const LaneT& there = graph_->town().lanes[to];
    const double room = std::max(here.length - from, 0.0);
    const double length = std::min(std::clamp(change_time * here.speed_limit, 20.0, 60.0), room);
    const double wait = std::clamp(change_after_, 0.0, room - length);
    change_after_ = 5;
    if (wait > 0)
        append_piece(lane, part_of(here, from, from + wait), here.speed_limit);
    const double start = path_.end();
    const double begin = from + wait;

    // A quintic step from one centre line to the other: no jump in heading or curvature.
    std::vector<Eigen::Vector3d> line;
    double s_there = 0;
    const int steps = std::max(2, static_cast<int>(length));
    for (int i = 0; i <= steps; ++i) {
        const double u = static_cast<double>(i) / steps;
        const double share = u * u * u * (10 + u * (6 * u - 15));
        const Eigen::Vector3d source = world::point_at(here, begin + u * length).position;
        s_there = world::project(there, source).s;
        const Eigen::Vector3d target = world::point_at(there, s_there).position;
        line.push_back(source + share * (target - source));
    }
    const std::size_t half = line.size() / 2;
    append_piece(lane,
                 {line.begin(), line.begin() + static_cast<std::ptrdiff_t>(half) + 1},
                 here.speed_limit);
    append_piece(
        to, {line.begin() + static_cast<std::ptrdiff_t>(half), line.end()}, there.speed_limit);
    changes_.push_back({start, path_.end(), lane, to, room - length - wait, to_the_left(here, to)});
    next_lane_ = to;
    next_s_ = s_there;
}

void Way::append_junction(std::uint32_t lane, std::uint32_t link_index) {
    const Link& link = graph_->town().lanes[lane].links[link_index];
    Gate gate;
    gate.s = path_.end();
    gate.serial = junctions_++;
    gate.signal = link.signal();
    gate.to = link.to();
    gate.turn = link.turn();
    gate.yields = link.yields();
    for (const std::uint32_t internal : graph_->inside(link))
        append_straight(internal, 0);
    gate.exit_s = path_.end();
    if (link.yields() || link.signal() != world::none)
        gate.foes = find_foes(*graph_, lane, link, gate.s);
    gates_.push_back(std::move(gate));
    next_lane_ = link.to();
    next_s_ = 0;
}

std::vector<std::uint32_t> Way::lanes_to_come(double s) const {
    std::vector<std::uint32_t> lanes;
    for (const PathPiece& piece : pieces_)
        if (piece.end >= s &&
            (lanes.empty() || graph_->town().lanes[piece.lane].kind == world::LaneKind::driving))
            lanes.push_back(piece.lane);
    if (!ended_ && (lanes.empty() || lanes.back() != next_lane_))
        lanes.push_back(next_lane_);
    lanes.insert(lanes.end(), route_.begin(), route_.end());
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
    hasher.add(std::uint64_t{route_.size()});
    for (const std::uint32_t lane : route_)
        hasher.add(lane);
    hasher.add(next_lane_);
    hasher.add(next_s_);
    hasher.add(change_after_);
    hasher.add(junctions_);
    hasher.add(ended_);
}

/// The long part of the digest: 20 kB of path, which changes a few times a minute only. Foes follow
/// from their gate and the town.
void Way::note_plan() {
    world::Hasher hasher;
    path_.add_to(hasher);
    hasher.add(std::uint64_t{gates_.size()});
    for (const Gate& gate : gates_) {
        hasher.add(gate.s);
        hasher.add(gate.exit_s);
        for (const std::uint32_t number : {gate.serial, gate.signal, gate.to})
            hasher.add(number);
        hasher.add(gate.turn);
        hasher.add(gate.yields);
        hasher.add(std::uint64_t{gate.foes.size()});
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

}  // namespace reprise::kernel
