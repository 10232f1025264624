#include "world/lanes/route_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace reprise::world {

namespace {

constexpr double announced = 25;                 // [m] before a junction
constexpr double same_junction = 15;             // [m] between two that are passed as one
constexpr double turned = std::numbers::pi / 4;  // [rad] less is straight on

/// A way through one or more junctions, along the route.
struct Manoeuvre {
    double entry = 0;
    double exit = 0;
    double turn = 0;      ///< [rad] sum of the turns inside, left positive
    bool choice = false;  ///< could one have gone elsewhere?
    RouteCommand single = RouteCommand::straight;
    int links = 0;
};

/// [rad] that a car turns between two places of a lane, left positive.
double turn_along(const LaneT& lane, double from, double to) {
    return std::remainder(point_at(lane, to).yaw - point_at(lane, from).yaw, 2 * std::numbers::pi);
}

/// Does the lane's street lead to more than one other street? Turning around does not count.
bool has_choice(const TownT& town, std::uint32_t lane) {
    const std::string* only = nullptr;
    for (const LaneT& one : town.lanes) {
        if (one.edge != town.lanes[lane].edge || one.kind != LaneKind::driving)
            continue;
        for (const Link& link : one.links) {
            if (link.to() >= town.lanes.size() || link.turn() == Turn::around)
                continue;
            const std::string& edge = town.lanes[link.to()].edge;
            if (only != nullptr && *only != edge)
                return true;
            only = &edge;
        }
    }
    return false;
}

RouteCommand command_of(const TownT& town, Turn turn) {
    switch (turn) {
        case Turn::left:
        case Turn::partially_left:
            return RouteCommand::left;
        case Turn::right:
        case Turn::partially_right:
            return RouteCommand::right;
        case Turn::around:
            return town.left_hand ? RouteCommand::right : RouteCommand::left;
        case Turn::straight:
            break;
    }
    return RouteCommand::straight;
}

RouteCommand command_of(const Manoeuvre& manoeuvre) {
    if (manoeuvre.links == 1)
        return manoeuvre.single;
    if (std::abs(manoeuvre.turn) < turned)
        return RouteCommand::straight;
    return manoeuvre.turn > 0 ? RouteCommand::left : RouteCommand::right;
}

std::vector<Manoeuvre> find_manoeuvres(const TownT& town, const std::vector<Route::Piece>& pieces) {
    std::vector<Manoeuvre> found;
    double since = 0;  // turn since the last junction: of a bend, or of a roundabout's circle
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Route::Piece& piece = pieces[i];
        const LaneT& lane = town.lanes[piece.lane];
        const double turn = turn_along(lane, piece.from, piece.to);
        const double end = piece.start + piece.to - piece.from;
        if (lane.kind == LaneKind::internal && !found.empty()) {
            found.back().turn += turn;
            found.back().exit = end;
        } else {
            since += turn;
        }
        const Link* link = lane.kind == LaneKind::driving && i + 1 < pieces.size()
                               ? link_between(town, piece.lane, pieces[i + 1].lane)
                               : nullptr;
        if (link == nullptr)
            continue;
        if (found.empty() || end - found.back().exit >= same_junction)
            found.push_back({end, end, 0, false, command_of(town, link->turn()), 0});
        else
            found.back().turn += since;
        since = 0;
        found.back().exit = end;
        found.back().choice = found.back().choice || has_choice(town, piece.lane);
        ++found.back().links;
    }
    return found;
}

}  // namespace

const Link* link_between(const TownT& town, std::uint32_t lane, std::uint32_t next) {
    for (const Link& link : town.lanes[lane].links)
        if (link.via() == next || (link.via() == none && link.to() == next))
            return &link;
    return nullptr;
}

std::vector<Route::Step> find_steps(const TownT& town, const Route& route) {
    std::vector<Route::Step> steps;
    double free = 0;  // where the last manoeuvre ended
    for (const Manoeuvre& manoeuvre : find_manoeuvres(town, route.pieces)) {
        if (!manoeuvre.choice)
            continue;
        const double begins = std::max(free, manoeuvre.entry - announced);
        if (begins > free || steps.empty())
            steps.push_back({RouteCommand::follow_lane, free});
        if (steps.back().begins == begins)
            steps.pop_back();
        steps.push_back({command_of(manoeuvre), begins});
        free = manoeuvre.exit;
    }
    if (free < route.length || steps.empty())
        steps.push_back({RouteCommand::follow_lane, free});
    steps.push_back({RouteCommand::reach_goal, route.length});
    return steps;
}

}  // namespace reprise::world
