// What it must do: find out from layers, which only order those who cross, how many storeys each
//   bridge is up and each tunnel down.
// What it assumes: ways lie on the tracks made of them, within a lane or so, in their direction.
// How it goes: ways of one layer that meet end to end are one span. Every place where two tracks
//   cross at different layers says which span is above which; levels follow, from the ground up
//   and down. Then the points of the spans, and those near a crossing, are marked.
// What it keeps: the order of tracks and of ways.
#include "towns/bridges/levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "towns/bridges/pieces.h"
#include "towns/bridges/spans.h"
#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::BoxGrid;
using world::none;

constexpr double overlap = 0.2;  ///< [m] roads that touch by less do not meet
constexpr double apron = 6;      ///< [m] beyond a crossing, level as well: kerbs, railings, room
constexpr double forking = 30;   ///< [m] from a common junction tracks cross without being above

bool cross_each_other(const Piece& one, const Piece& other) {
    return world::distance_to({one.from, one.to}, other.from, other.to) == 0;
}

/// Of two pieces that cross each other.
Vector2d meeting_point(const Piece& one, const Piece& other) {
    const Vector2d along = one.to - one.from;
    const Vector2d across = other.to - other.from;
    const double turn = world::cross(along, across);
    const double share = turn == 0 ? 0.5 : world::cross(other.from - one.from, across) / turn;
    return one.from + along * std::clamp(share, 0.0, 1.0);
}

/// One track passes over another. Spans are none where a track is on the ground.
struct Overpass {
    Vector2d place;
    std::uint32_t upper_track = 0, lower_track = 0;
    std::uint32_t upper = none, lower = none;
};

class LevelFinder {
  public:
    LevelFinder(const RoadChains& roads,
                const std::vector<MapShape>& ways,
                const std::set<std::uint32_t>& flat)
        : roads_(roads),
          spans_(ways),
          flat_(flat) {}

    Levels find();

  private:
    void find_overpasses();
    void take_crossing(const Piece& one, const Piece& other);
    void keep_together(const Piece& one, const Piece& other);
    std::vector<std::uint32_t> points_near(const Track& track,
                                           const Vector2d& place,
                                           double reach) const;
    bool fork(const Track& one, const Track& other, const Vector2d& place) const;
    bool is_above(std::uint32_t span, std::uint32_t other) const;
    void number_spans();
    void mark_spans();
    void mark_near(std::uint32_t track, const Vector2d& place, double reach, std::uint32_t span);
    void mark(std::uint32_t point, std::uint32_t span);
    int places() const;

    int level(std::uint32_t span) const { return span == none ? 0 : levels_of_spans_[span]; }

    /// The map's, unless the span must stay flat.
    int layer(std::uint32_t span) const { return flat_.contains(span) ? 0 : spans_.layer(span); }

    const RoadChains& roads_;
    Spans spans_;
    const std::set<std::uint32_t>& flat_;
    std::vector<Overpass> overpasses_;
    std::vector<int> levels_of_spans_;
    Levels found_;
};

/// Lanes of one road, and tracks near a junction that they share, are no crossing: there, one
/// leaves the other.
bool LevelFinder::fork(const Track& one, const Track& other, const Vector2d& place) const {
    if (one.chain != none && one.chain == other.chain)
        return true;
    for (const std::uint32_t end : {one.points.front(), one.points.back()})
        for (const std::uint32_t other_end : {other.points.front(), other.points.back()})
            if (end == other_end && (roads_.places[end] - place).norm() < forking)
                return true;
    return false;
}

/// Where roads cross, both are level; where they touch, they have the same height.
void LevelFinder::keep_together(const Piece& one, const Piece& other) {
    const Track& track = roads_.tracks[one.owner];
    const Track& other_track = roads_.tracks[other.owner];
    const bool crossing = cross_each_other(one, other);
    const auto reach = [&](double half_width) { return crossing ? half_width + apron : 0; };
    const Vector2d place = crossing ? meeting_point(one, other) : one.from;
    std::vector<std::uint32_t> points = points_near(track, place, reach(other_track.half_width));
    for (const std::uint32_t point : points_near(other_track, place, reach(track.half_width)))
        points.push_back(point);
    (crossing ? found_.crossed : found_.touching).push_back(std::move(points));
}

/// Those of a track that are within reach of a place; one at least.
std::vector<std::uint32_t> LevelFinder::points_near(const Track& track,
                                                    const Vector2d& place,
                                                    double reach) const {
    std::vector<std::uint32_t> near;
    std::uint32_t nearest = track.points.front();
    for (const std::uint32_t point : track.points) {
        const double distance = (roads_.places[point] - place).norm();
        if (distance < reach)
            near.push_back(point);
        if (distance < (roads_.places[nearest] - place).norm())
            nearest = point;
    }
    return near.empty() ? std::vector<std::uint32_t>{nearest} : near;
}

/// Not where a flat span would change places with what the map has below it.
bool LevelFinder::is_above(std::uint32_t span, std::uint32_t other) const {
    return spans_.layer(span) > spans_.layer(other) && layer(span) > layer(other);
}

void LevelFinder::take_crossing(const Piece& one, const Piece& other) {
    const Track& track = roads_.tracks[one.owner];
    const Track& other_track = roads_.tracks[other.owner];
    const Vector2d place = (one.from + one.to) / 2;
    if (fork(track, other_track, place))
        return;
    const std::uint32_t span = spans_.at(place, (one.to - one.from).normalized(), track);
    const std::uint32_t other_span =
        spans_.at((other.from + other.to) / 2, (other.to - other.from).normalized(), other_track);
    if (is_above(span, other_span))
        overpasses_.push_back({place, one.owner, other.owner, span, other_span});
    else if (is_above(other_span, span))
        overpasses_.push_back({place, other.owner, one.owner, other_span, span});
    else
        keep_together(one, other);
}

/// Looks at every two pieces of which one may lie over the other.
void LevelFinder::find_overpasses() {
    std::vector<Piece> pieces;
    double widest = 0;
    for (std::uint32_t i = 0; i < roads_.tracks.size(); ++i) {
        add_pieces(roads_.tracks[i].line, i, "", pieces);
        widest = std::max(widest, roads_.tracks[i].half_width);
    }
    const BoxGrid by_place = grid_of(pieces);
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
        const Piece& one = pieces[i];
        const double half_width = roads_.tracks[one.owner].half_width;
        for (const std::uint32_t k : by_place.near(box_of(one, half_width + widest))) {
            const Piece& other = pieces[k];
            const double apart = half_width + roads_.tracks[other.owner].half_width - overlap;
            if (k > i && other.owner != one.owner &&
                world::distance_to({one.from, one.to}, other.from, other.to) < apart)
                take_crossing(one, other);
        }
    }
}

/// Tunnels from the highest layer downwards: one storey under the lowest that they cross. Bridges
/// likewise, upwards. A bridge over a tunnel that is down already needs no ramp for that.
void LevelFinder::number_spans() {
    levels_of_spans_.assign(spans_.size(), 0);
    std::vector<std::uint32_t> order(spans_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t one, std::uint32_t other) {
        return std::pair(layer(one) > 0, std::abs(layer(one))) <
               std::pair(layer(other) > 0, std::abs(layer(other)));
    });
    for (const std::uint32_t span : order)
        for (const Overpass& overpass : overpasses_) {
            int& level = levels_of_spans_[span];
            const bool is_down = layer(overpass.lower) < 0 && this->level(overpass.lower) < 0;
            if (overpass.upper == span && layer(span) > 0 && !is_down)
                level = std::max(level, this->level(overpass.lower) + 1);
            if (overpass.lower == span && layer(span) < 0 && layer(overpass.upper) <= 0)
                level = std::min(level, this->level(overpass.upper) - 1);
        }
}

/// What belongs to a bridge is not the ground below it.
void LevelFinder::mark(std::uint32_t point, std::uint32_t span) {
    const int level = this->level(span);
    const auto [known, is_new] = found_.levels.try_emplace(point, level);
    if (!is_new && std::abs(level) > std::abs(known->second))
        known->second = level;
    if (level != 0)
        found_.spans[span].push_back(point);
}

void LevelFinder::mark_near(std::uint32_t track,
                            const Vector2d& place,
                            double reach,
                            std::uint32_t span) {
    for (const std::uint32_t point : points_near(roads_.tracks[track], place, reach))
        mark(point, span);
}

void LevelFinder::mark_spans() {
    for (const Track& track : roads_.tracks) {
        const std::size_t last = track.points.size() - 1;
        for (std::size_t i = 0; i <= last && last > 0; ++i) {
            const LinePoint spot =
                point_along(track.line, static_cast<double>(i) / static_cast<double>(last));
            const std::uint32_t span = spans_.at(spot.place, spot.direction, track);
            if (level(span) != 0)
                mark(track.points[i], span);
        }
    }
}

/// Roads with two directions and many lanes are counted once.
int LevelFinder::places() const {
    std::set<std::array<std::uint32_t, 4>> crossing;
    for (const Overpass& overpass : overpasses_) {
        const auto& upper = roads_.tracks[overpass.upper_track].points;
        const auto& lower = roads_.tracks[overpass.lower_track].points;
        const auto [over, over_end] = std::minmax(upper.front(), upper.back());
        const auto [under, under_end] = std::minmax(lower.front(), lower.back());
        crossing.insert({over, over_end, under, under_end});
    }
    return static_cast<int>(crossing.size());
}

Levels LevelFinder::find() {
    find_overpasses();
    number_spans();
    found_.spans.resize(spans_.size());
    for (const Overpass& overpass : overpasses_) {
        const double upper_width = roads_.tracks[overpass.upper_track].half_width;
        const double lower_width = roads_.tracks[overpass.lower_track].half_width;
        mark_near(overpass.upper_track, overpass.place, lower_width + apron, overpass.upper);
        mark_near(overpass.lower_track, overpass.place, upper_width + apron, overpass.lower);
    }
    mark_spans();
    found_.crossings = places();
    return std::move(found_);
}

}  // namespace

Levels find_levels(const RoadChains& roads,
                   const std::vector<MapShape>& ways,
                   const std::set<std::uint32_t>& flat) {
    return LevelFinder(roads, ways, flat).find();
}

}  // namespace reprise::towns
