#include "world/lanes/route_progress.h"

#include <algorithm>

#include "world/town.h"

namespace reprise::world {

namespace {

constexpr double short_cut = 20;  ///< [m] a corner that is cut, a junction crossed on another lane

bool is_on(const TownT& town, const Route::Piece& piece, LanePlace place) {
    if (piece.lane == place.lane)
        return true;
    const LaneT& lane = town.lanes[place.lane];
    return lane.kind == LaneKind::driving && lane.edge == town.lanes[piece.lane].edge;
}

}  // namespace

std::optional<Route> plan_over(const Planner& planner,
                               LanePlace from,
                               std::span<const std::uint32_t> stops,
                               double last_s) {
    if (stops.size() > 1 && stops.front() == from.lane)
        stops = stops.subspan(1);
    Route whole;
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const LanePlace to{stops[i], i + 1 == stops.size() ? last_s : 0};
        const auto leg = planner.plan(from, to);
        if (!leg)
            return std::nullopt;
        for (Route::Piece piece : leg->pieces) {
            piece.start += whole.length;
            whole.pieces.push_back(piece);
        }
        whole.length += leg->length;
        from = to;
    }
    whole.steps = {{RouteCommand::reach_goal, whole.length}};
    return whole;
}

void RouteProgress::drive_on(const TownT& town,
                             std::optional<LanePlace> place,
                             double driven,
                             double front) {
    if (arrived_)
        return;
    beside_ += driven;
    const double farthest = along_ + beside_ + short_cut;
    for (std::size_t i = piece_; place && i < route_.pieces.size(); ++i) {
        const Route::Piece& piece = route_.pieces[i];
        if (piece.start > farthest)
            break;
        if (!is_on(town, piece, *place))
            continue;
        const double s = beside(town.lanes[place->lane], place->s, town.lanes[piece.lane]);
        const double along = piece.start + std::clamp(s, piece.from, piece.to) - piece.from;
        if (along > farthest)
            break;
        // Where lanes are changed the next piece goes on beside this one.
        if (s > piece.to && i + 1 < route_.pieces.size() &&
            is_on(town, route_.pieces[i + 1], *place))
            continue;
        along_ = std::max(along_, along);
        piece_ = i;
        beside_ = 0;
        arrived_ = along_ + front >= route_.length;
        break;
    }
}

double RouteProgress::share() const {
    if (arrived_)
        return 1;
    return route_.length > 0 ? std::min(along_ / route_.length, 1.0) : 0;
}

}  // namespace reprise::world
