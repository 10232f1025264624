#include "drivers/way/lane_graph.h"

#include <algorithm>
#include <functional>

#include "drivers/way/tight_ways.h"
#include "world/check.h"
#include "world/lanes/junctions.h"

namespace reprise::drivers {

namespace {

using world::LaneKind;
using world::LaneT;
using world::Link;

}  // namespace

LaneGraph::LaneGraph(const world::TownT& town)
    : town_(&town),
      exit_(town.lanes.size(), world::none),
      incoming_(town.junctions.size()),
      has_stop_sign_(world::lanes_with_stop_sign(town)),
      has_crossing_(town.junctions.size(), false) {
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const LaneT& lane = town.lanes[i];
        if (lane.kind == LaneKind::crossing && lane.junction < has_crossing_.size())
            has_crossing_[lane.junction] = true;
        if (lane.kind != LaneKind::driving)
            continue;
        if (lane.junction < incoming_.size())
            incoming_[lane.junction].push_back(i);
        for (const Link& link : lane.links)
            if (world::leads_on(town, link))
                for (const std::uint32_t internal : inside(link))
                    exit_[internal] = link.to();
    }
    find_dead_ends();
    find_circles();
}

Continuation LaneGraph::continuation(const Link& link) const {
    if (!world::leads_on(*town_, link))
        return Continuation::dead_end;
    const Continuation behind = continuation_[link.to()];
    return link.turn() == world::Turn::around ? std::min(behind, Continuation::turning) : behind;
}

Continuation LaneGraph::straight_continuation(std::uint32_t lane) const {
    Continuation best = Continuation::dead_end;
    for (const Link& link : town_->lanes[lane].links)
        best = std::max(best, continuation(link));
    return best;
}

void LaneGraph::find_dead_ends() {
    const auto count = static_cast<std::uint32_t>(town_->lanes.size());
    continuation_.assign(count, Continuation::free);
    // Mark down what promises more than its links and neighbours hold until nothing changes; as
    // many rounds as the longest blind alley.
    for (bool changed = true; changed;) {
        changed = false;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (town_->lanes[i].kind != LaneKind::driving)
                continue;
            Continuation best = straight_continuation(i);
            if (best < continuation_[i] && town_->lanes[i].length >= shortest_change)
                for (const std::uint32_t to : reachable_sideways(i))
                    best = std::max(best, straight_continuation(to));
            changed = changed || best < continuation_[i];
            continuation_[i] = std::min(continuation_[i], best);
        }
    }
}

/// The lane behind it where there is no choice, but for turning around; else none.
std::uint32_t LaneGraph::only_way_on(std::uint32_t lane) const {
    std::uint32_t only = world::none;
    for (const Link& link : town_->lanes[lane].links) {
        if (link.turn() == world::Turn::around || !world::leads_on(*town_, link))
            continue;
        if (only != world::none)
            return world::none;
        only = link.to();
    }
    return only;
}

/// Lanes whose only way on comes back to them, and those that lead nowhere but there.
void LaneGraph::find_circles() {
    constexpr double longest = 400;  // [m] who goes round a larger one sees something of the town
    const auto count = static_cast<std::uint32_t>(town_->lanes.size());
    circles_.assign(count, false);
    for (std::uint32_t start = 0; start < count; ++start) {
        if (circles_[start] || town_->lanes[start].kind != LaneKind::driving)
            continue;
        std::vector<std::uint32_t> way;
        double length = 0;
        for (std::uint32_t lane = only_way_on(start); lane != world::none && length < longest;
             lane = only_way_on(lane)) {
            length += town_->lanes[lane].length;
            way.push_back(lane);
            if (lane != start)
                continue;
            for (const std::uint32_t one : way)
                circles_[one] = true;
            break;
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t on =
                town_->lanes[i].kind == LaneKind::driving ? only_way_on(i) : world::none;
            if (circles_[i] || on == world::none || !circles_[on])
                continue;
            circles_[i] = changed = true;
        }
    }
}

std::vector<std::uint32_t> LaneGraph::choices(std::uint32_t lane) const {
    const std::vector<Link>& links = town_->lanes[lane].links;
    const Continuation best = straight_continuation(lane);
    std::vector<std::uint32_t> best_ones;
    for (std::uint32_t i = 0; i < links.size(); ++i)
        if (world::leads_on(*town_, links[i]) && continuation(links[i]) == best)
            best_ones.push_back(i);
    // To turn here is no better than to turn later, unless there is no later.
    const auto keep = [&](const auto& is_wanted) {
        if (std::any_of(best_ones.begin(), best_ones.end(), is_wanted))
            std::erase_if(best_ones, std::not_fn(is_wanted));
    };
    keep([&](std::uint32_t i) { return links[i].turn() != world::Turn::around; });
    keep([&](std::uint32_t i) { return !circles_[links[i].to()]; });
    if (best_ones.size() > 1)
        keep([&](std::uint32_t i) { return !is_tight(lane, links[i]); });
    return best_ones;
}

bool LaneGraph::is_tight(std::uint32_t lane, const Link& link) const {
    std::vector<std::uint32_t> way = inside(link);
    way.insert(way.begin(), lane);
    way.push_back(link.to());
    return drivers::is_tight(*town_, way);
}

std::vector<std::uint32_t> LaneGraph::reachable_sideways(std::uint32_t lane) const {
    constexpr int most = 16;
    std::vector<std::uint32_t> found;
    std::uint32_t right = lane;
    std::uint32_t left = lane;
    for (int steps = 0; steps < most && (right != world::none || left != world::none); ++steps) {
        for (std::uint32_t* side : {&right, &left}) {
            if (*side == world::none)
                continue;
            *side = side == &right ? town_->lanes[*side].right : town_->lanes[*side].left;
            if (*side < town_->lanes.size() && town_->lanes[*side].kind == LaneKind::driving)
                found.push_back(*side);
            else
                *side = world::none;
        }
    }
    return found;
}

std::optional<LaneGraph::Better> LaneGraph::better_lane(std::uint32_t lane) const {
    const Continuation here = straight_continuation(lane);
    const std::vector<std::uint32_t> sideways = reachable_sideways(lane);
    const auto better = std::find_if(sideways.begin(), sideways.end(), [&](std::uint32_t to) {
        const Continuation there = straight_continuation(to);
        return there > here || (there == here && circles_[lane] && !circles_[to]);
    });
    if (better == sideways.end())
        return std::nullopt;
    for (const auto side : {&LaneT::right, &LaneT::left}) {
        int changes = 1;
        for (std::uint32_t to = town_->lanes[lane].*side; to != world::none;
             to = town_->lanes[to].*side, ++changes)
            if (to == *better)
                return Better{town_->lanes[lane].*side, changes};
    }
    return std::nullopt;
}

std::vector<std::uint32_t> LaneGraph::inside(const Link& link) const {
    std::vector<std::uint32_t> lanes;
    std::uint32_t via = link.via();
    while (via < town_->lanes.size() && lanes.size() < 16) {
        lanes.push_back(via);
        const std::vector<Link>& links = town_->lanes[via].links;
        const auto on = std::find_if(links.begin(), links.end(), [&](const Link& next) {
            return next.to() == link.to() || next.via() != world::none;
        });
        via = on == links.end() ? world::none : on->via();
        // A network may also name the next internal lane as the target itself.
        if (via == world::none && on == links.end() && !links.empty() &&
            links.front().to() < town_->lanes.size() &&
            town_->lanes[links.front().to()].kind == LaneKind::internal)
            via = links.front().to();
    }
    return lanes;
}

std::span<const std::uint32_t> LaneGraph::incoming(std::uint32_t junction) const {
    if (junction >= incoming_.size())
        return {};
    return incoming_[junction];
}

Plan LaneGraph::plan(world::LanePlace from,
                     std::span<const std::uint32_t> stops,
                     double last_s,
                     world::LaneChanges changes) const {
    const world::Planner planner(*town_, changes);
    Plan plan;
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const std::uint32_t stop = stops[i];
        REPRISE_CHECK(stop < town_->lanes.size(), "lane " + std::to_string(stop));
        const LaneT& goal = town_->lanes[stop];
        const bool last = i + 1 == stops.size();
        const auto route = goal.kind == LaneKind::driving
                               ? planner.plan(from, {stop, last ? last_s : goal.length})
                               : std::nullopt;
        if (!route) {
            plan.unreachable = stop;
            return plan;
        }
        const std::vector<std::uint32_t> leg = world::driving_lanes(*town_, *route);
        // An internal lane, where it begins on one, is not among them.
        const bool begins_here = !leg.empty() && leg.front() == from.lane;
        plan.lanes.insert(plan.lanes.end(), leg.begin() + (begins_here ? 1 : 0), leg.end());
        plan.length += route->length;
        from = {stop, 0};
    }
    return plan;
}

std::optional<Detour> LaneGraph::detour(std::uint32_t lane,
                                        std::span<const std::uint32_t> stops,
                                        double last_s,
                                        world::LaneChanges changes) const {
    std::optional<Detour> best;
    const std::vector<Link>& links = town_->lanes[lane].links;
    for (std::uint32_t i = 0; i < links.size(); ++i) {
        if (links[i].to() >= town_->lanes.size())
            continue;
        Plan way = plan({links[i].to(), 0}, stops, last_s, changes);
        if (way.unreachable == world::none && (!best || way.length < best->plan.length))
            best = Detour{i, std::move(way)};
    }
    return best;
}

}  // namespace reprise::drivers
