#include "towns/bridges/spans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace reprise::towns {

using Eigen::Vector2d;
using world::Box;
using world::none;

namespace {

constexpr double beside = 3;     // [m] a way may lie this far outside of its track
constexpr double aligned = 0.9;  // cosine between a way and its track

}  // namespace

Spans::Spans(const std::vector<MapShape>& ways) : span_of_way_(ways.size()) {
    join(ways);
    for (std::uint32_t i = 0; i < ways.size(); ++i)
        add_pieces(world::in_plan(ways[i].line),
                   span_of_way_[i],
                   std::string_view(ways[i].id).substr(0, ways[i].id.find('#')),
                   pieces_);
    by_place_ = grid_of(pieces_);
}

/// Numbers the spans; a way takes the number of the first one that it is joined to.
void Spans::join(const std::vector<MapShape>& ways) {
    std::vector<std::uint32_t> first(ways.size());
    std::iota(first.begin(), first.end(), 0U);
    const auto root = [&](std::uint32_t way) {
        while (first[way] != way)
            way = first[way];
        return way;
    };
    std::map<std::array<double, 3>, std::uint32_t> ends;
    for (std::uint32_t i = 0; i < ways.size(); ++i)
        for (const world::Vec3& end : {ways[i].line.front(), ways[i].line.back()}) {
            const double layer = layer_of(ways[i].tags);
            const auto [known, is_new] = ends.try_emplace({layer, end.x(), end.y()}, i);
            if (!is_new)
                first[std::max(root(i), root(known->second))] =
                    std::min(root(i), root(known->second));
        }
    for (std::uint32_t i = 0; i < ways.size(); ++i) {
        if (first[i] == i) {
            span_of_way_[i] = static_cast<std::uint32_t>(layers_.size());
            layers_.push_back(layer_of(ways[i].tags));
        } else {
            span_of_way_[i] = span_of_way_[root(i)];
        }
    }
}

std::uint32_t Spans::at(const Vector2d& place,
                        const Vector2d& direction,
                        const Track& track) const {
    const double reach = track.half_width + beside;
    Box box;
    box.take(place, reach);
    std::uint32_t found = none;
    double nearest = reach;
    for (const std::uint32_t i : by_place_.near(box)) {
        const Piece& piece = pieces_[i];
        const double distance = world::distance_to({place}, piece.from, piece.to);
        const Vector2d along = (piece.to - piece.from).normalized();
        if (distance >= nearest || std::abs(along.dot(direction)) < aligned ||
            std::find(track.ways.begin(), track.ways.end(), piece.way) == track.ways.end())
            continue;
        nearest = distance;
        found = piece.owner;
    }
    return found;
}

}  // namespace reprise::towns
