#include "world/lanes/route.h"

#include <algorithm>

#include "world/frames.h"

namespace reprise::world {

namespace {

constexpr double change_half = 15;  // [m] half the longest change of lanes

bool same_edge(const TownT& town, std::uint32_t lane, std::uint32_t other) {
    return town.lanes[lane].edge == town.lanes[other].edge;
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
