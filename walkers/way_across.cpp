#include "walkers/way_across.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::walkers {

namespace {

using ground::Surface;
using Way = std::vector<WalkMap::Step>;

constexpr double widest_road = 25;      // [m] nobody crosses a wider one in one go
constexpr double near_crossing = 8;     // [m] who is that near to one takes it
constexpr unsigned most_crossings = 3;  // of a way, beside marked ones

/// First corner from which it goes on over the road; size(): none.
std::size_t first_on_road(const Way& way) {
    const auto at = std::find_if(way.begin(), way.end() - 1, [](const WalkMap::Step& step) {
        return step.surface == Surface::road;
    });
    return at == way.end() - 1 ? way.size() : static_cast<std::size_t>(at - way.begin());
}

/// Over the street at this kerb, to the side of `towards`; none in a junction and near a crossing.
std::optional<Eigen::Vector2d> straight_over(const StreetMaps& maps,
                                             const Eigen::Vector3d& kerb,
                                             const Eigen::Vector3d& towards) {
    constexpr double beside = 8;  // [m] a lane's middle behind a bus bay
    double nearest = beside;
    std::optional<Eigen::Vector2d> ahead;
    for (const std::uint32_t i : maps.lanes.near(kerb, beside)) {
        const world::LaneT& lane = maps.town.lanes[i];
        const bool is_crossing = lane.kind == world::LaneKind::crossing;
        if (!is_crossing && !world::is_for_cars(lane))
            continue;
        const world::LaneProjection at = world::project(lane, kerb);
        if (is_crossing && at.distance < near_crossing)
            return std::nullopt;
        if (is_crossing || at.distance >= nearest)
            continue;
        nearest = at.distance;
        ahead.reset();
        if (lane.kind == world::LaneKind::driving)
            ahead = world::ahead_of(world::point_at(lane, at.s).yaw);
    }
    if (!ahead)
        return std::nullopt;
    const Eigen::Vector2d left = world::turned_left(*ahead);
    return left.dot((towards - kerb).head<2>()) < 0 ? Eigen::Vector2d(-left) : left;
}

/// Where somebody comes to the pavement who goes straight over from the kerb; none where something
/// is in his way.
std::optional<WalkMap::Place> other_side(const WalkMap& map,
                                         const WalkMap::Place& kerb,
                                         const Eigen::Vector2d& across) {
    constexpr double piece = 0.5;   // [m]
    constexpr double aside = 0.05;  // [m]
    bool was_on_road = false;
    WalkMap::Place here = kerb;
    for (double far = piece; far < widest_road; far += piece) {
        const Eigen::Vector3d next =
            kerb.position + far * Eigen::Vector3d(across.x(), across.y(), 0);
        here = map.slide(here, next);
        if ((here.position - next).head<2>().norm() > aside)
            return std::nullopt;
        const Surface surface = map.surface(here);
        if (surface == Surface::sidewalk && was_on_road)
            return here;
        was_on_road = was_on_road || surface == Surface::road;
    }
    return std::nullopt;
}

/// From a place on the pavement to another by the pavement alone; none: not both are on it, or no
/// way leads there.
std::optional<Way> by_pavement(const WalkMap& pavement,
                               const Eigen::Vector3d& from,
                               const Eigen::Vector3d& to) {
    auto way = pavement.path(from, to);
    return way && way->size() > 1 ? std::move(way) : std::nullopt;
}

/// Straight over the road, from the pavement onto the pavement.
struct Crossing {
    Eigen::Vector3d from;
    Eigen::Vector3d to;
};

/// The first one on the cheapest way by streets.
std::optional<Crossing> first_crossing(const StreetMaps& maps,
                                       const WalkMap::Place& from,
                                       const WalkMap::Place& goal,
                                       double road_cost) {
    constexpr double onto_pavement = 0.6;  // [m] from the kerb
    const auto way = maps.streets.path(from, goal, {std::min(1.5, road_cost), road_cost});
    if (!way || way->size() < 2)
        return std::nullopt;
    const std::size_t kerb = first_on_road(*way);
    if (kerb == way->size())
        return std::nullopt;
    const auto at_kerb = maps.streets.nearest((*way)[kerb].position);
    const auto across = straight_over(maps, (*way)[kerb].position, (*way)[kerb + 1].position);
    const auto landing =
        at_kerb && across ? other_side(maps.streets, *at_kerb, *across) : std::nullopt;
    if (!landing)
        return std::nullopt;
    const Eigen::Vector3d inwards = onto_pavement * Eigen::Vector3d(across->x(), across->y(), 0);
    const auto here = maps.pavement.nearest(at_kerb->position - inwards);
    const auto there = maps.pavement.nearest(landing->position + inwards);
    if (!here || !there)
        return std::nullopt;
    return Crossing{here->position, there->position};
}

}  // namespace

std::optional<Way> way_across(const StreetMaps& maps,
                              const WalkMap::Place& from,
                              const WalkMap::Place& goal,
                              double road_cost) {
    Way done;
    WalkMap::Place here = from;
    for (unsigned crossed = 0; crossed < most_crossings; ++crossed) {
        const auto crossing = first_crossing(maps, here, goal, road_cost);
        if (!crossing)
            break;
        const auto there = maps.streets.nearest(crossing->to);
        auto way = by_pavement(maps.pavement, here.position, crossing->from);
        if (!way || !there)
            break;
        way->back().surface = Surface::road;
        done.insert(done.end(), way->begin(), way->end());
        here = *there;
    }
    auto rest = by_pavement(maps.pavement, here.position, goal.position);
    if (!rest)
        rest = maps.streets.path(here, goal);
    if (!rest || rest->size() < 2)
        return std::nullopt;
    done.insert(done.end(), rest->begin(), rest->end());
    return done;
}

}  // namespace reprise::walkers
