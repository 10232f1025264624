#include "world/route.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/check.h"
#include "world/frames.h"

namespace reprise::world {

namespace {

constexpr double announced = 25;                 // [m] before a junction
constexpr double same_junction = 15;             // [m] between two that are passed as one
constexpr double change_half = 15;               // [m] half the longest change of lanes
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

bool same_edge(const TownT& town, std::uint32_t lane, std::uint32_t other) {
    return town.lanes[lane].edge == town.lanes[other].edge;
}

/// [rad] that a car turns between two places of a lane, left positive.
double turn_along(const LaneT& lane, double from, double to) {
    return std::remainder(point_at(lane, to).yaw - point_at(lane, from).yaw, 2 * std::numbers::pi);
}

const Link* link_between(const TownT& town, std::uint32_t lane, std::uint32_t next) {
    for (const Link& link : town.lanes[lane].links)
        if (link.via() == next || (link.via() == none && link.to() == next))
            return &link;
    return nullptr;
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

/// The piece that holds the place, or the nearest one on its edge.
const Route::Piece* piece_at(const TownT& town, const Route& route, LanePlace place) {
    const Route::Piece* best = nullptr;
    double least = 0;
    for (const Route::Piece& piece : route.pieces) {
        if (!same_edge(town, piece.lane, place.lane))
            continue;
        const double s = beside(town.lanes[place.lane], place.s, town.lanes[piece.lane]);
        const double away = std::max({piece.from - s, s - piece.to, 0.0});
        if (best == nullptr || away < least) {
            best = &piece;
            least = away;
        }
    }
    return best;
}

void add_point(std::vector<Eigen::Vector3d>& line, const Eigen::Vector3d& p) {
    if (line.empty() || (p - line.back()).norm() > 1e-6)
        line.push_back(p);
}

void add_stretch(std::vector<Eigen::Vector3d>& line, const LaneT& lane, double from, double to) {
    add_point(line, point_at(lane, from).position);
    double s = 0;
    for (std::size_t i = 1; i + 1 < lane.centre.size(); ++i) {
        s += (to_eigen(lane.centre[i]) - to_eigen(lane.centre[i - 1])).norm();
        if (s > from && s < to)
            add_point(line, to_eigen(lane.centre[i]));
    }
    add_point(line, point_at(lane, to).position);
}

}  // namespace

const char* name_of(RouteCommand command) {
    switch (command) {
        case RouteCommand::follow_lane:
            return "follow_lane";
        case RouteCommand::straight:
            return "straight";
        case RouteCommand::left:
            return "left";
        case RouteCommand::right:
            return "right";
        case RouteCommand::reach_goal:
            break;
    }
    return "reach_goal";
}

Route make_route(const TownT& town,
                 const std::vector<std::uint32_t>& lanes,
                 double from_s,
                 double to_s) {
    REPRISE_CHECK(!lanes.empty(), "a route of no lanes");
    Route route;
    double begin = from_s;  // on the first lane of the edge
    for (std::size_t first = 0; first < lanes.size();) {
        // Lanes that are changed on one edge share its length.
        std::size_t last = first;
        while (last + 1 < lanes.size() &&
               link_between(town, lanes[last], lanes[last + 1]) == nullptr)
            ++last;
        const LaneT& goal = town.lanes[lanes[last]];
        const double goal_s = last + 1 == lanes.size() ? to_s : goal.length;
        const double end = beside(goal, goal_s, town.lanes[lanes[first]]);
        const double share = (end - begin) / static_cast<double>(last - first + 1);
        for (std::size_t i = first; i <= last; ++i) {
            const LaneT& lane = town.lanes[lanes[i]];
            const double scale = lane.length / town.lanes[lanes[first]].length;
            const double from = begin + share * static_cast<double>(i - first);
            route.pieces.push_back({lanes[i],
                                    from * scale,
                                    i == last ? goal_s : (from + share) * scale,
                                    route.length});
            route.length += route.pieces.back().to - route.pieces.back().from;
        }
        begin = 0;
        first = last + 1;
    }
    route.steps = find_steps(town, route);
    return route;
}

std::vector<std::uint32_t> driving_lanes(const TownT& town, const Route& route) {
    std::vector<std::uint32_t> lanes;
    for (const Route::Piece& piece : route.pieces)
        if (town.lanes[piece.lane].kind == LaneKind::driving)
            lanes.push_back(piece.lane);
    return lanes;
}

RouteCommand command_at(const Route& route, double along) {
    RouteCommand command = RouteCommand::follow_lane;
    for (const Route::Step& step : route.steps)
        if (step.begins <= along)
            command = step.command;
    return command;
}

std::optional<double> distance_to_goal(const TownT& town, const Route& route, LanePlace place) {
    const Route::Piece* const piece = piece_at(town, route, place);
    if (piece == nullptr)
        return std::nullopt;
    const double s = beside(town.lanes[place.lane], place.s, town.lanes[piece->lane]);
    return route.length - (piece->start + std::clamp(s, piece->from, piece->to) - piece->from);
}

std::vector<Eigen::Vector3d> centre_line(const TownT& town, const Route& route) {
    std::vector<Eigen::Vector3d> line;
    for (std::size_t i = 0; i < route.pieces.size(); ++i) {
        const Route::Piece& piece = route.pieces[i];
        const double margin = std::min(change_half, (piece.to - piece.from) / 2);
        const bool changed = i > 0 && same_edge(town, piece.lane, route.pieces[i - 1].lane);
        const bool changes =
            i + 1 < route.pieces.size() && same_edge(town, piece.lane, route.pieces[i + 1].lane);
        add_stretch(line,
                    town.lanes[piece.lane],
                    piece.from + (changed ? margin : 0),
                    piece.to - (changes ? margin : 0));
    }
    return line;
}

}  // namespace reprise::world
