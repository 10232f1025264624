// Where they go: goals that the seed draws, ways to them, each on his own side.
#include "walkers/crowd.h"
#include "walkers/way_across.h"
#include "world/geometry2d.h"
#include "world/random.h"

namespace reprise::walkers {

namespace {

using world::Purpose;

constexpr unsigned plans_a_tick = 4;  // ways found in one tick, behind the first

}  // namespace

/// To his own side of the straightest way, which everybody else takes as well; where the way is as
/// clear there.
void Crowd::keep_to_side(const WalkMap& map,
                         const WalkMap::Place& start,
                         double side,
                         std::vector<WalkMap::Step>& way) {
    constexpr double on_pavement = 0.1;  // [m]
    WalkMap::Place before = start;
    for (std::size_t i = 1; i + 1 < way.size(); ++i) {
        const Eigen::Vector2d in = (way[i].position - way[i - 1].position).head<2>().normalized();
        const Eigen::Vector2d out = (way[i + 1].position - way[i].position).head<2>().normalized();
        const Eigen::Vector2d right = -world::turned_left(in + out).normalized();
        const auto corner = map.nearest(way[i].position);
        // On the road there are no sides to keep to.
        if (!corner || (corner->position - way[i].position).head<2>().norm() > on_pavement)
            continue;
        WalkMap::Place at = *corner;
        if (right.allFinite()) {
            const Eigen::Vector2d aside = side * right;
            const WalkMap::Place there =
                map.slide(at, at.position + Eigen::Vector3d(aside.x(), aside.y(), 0));
            // Over the end of a crossing that he does not take he would not get.
            if (map.is_clear(before, there.position, way[i - 1].surface) &&
                map.is_clear(there, way[i + 1].position, way[i].surface))
                at = there;
        }
        way[i].position = at.position;
        before = at;
    }
}

bool Crowd::take_way(Walker& walker, const WalkMap::Place& goal) {
    const WalkMap& pavement = ground_->pavement();
    const WalkMap& map = map_of(walker.person);
    const double road_cost = walker.gave_up ? WalkMap::Costs{}.road : walker.person.road_cost;
    auto way = walker.person.jaywalks
                   ? way_across({pavement, map, *town_, *lanes_}, walker.place, goal, road_cost)
                   : map.path(walker.place, goal);
    if (!way || way->size() < 2)
        return false;
    if (const auto start = pavement.nearest(walker.place.position))
        keep_to_side(pavement, *start, walker.person.side, *way);
    walker.way = std::move(*way);
    walker.corner = 1;
    walker.gates = gates_of(walker.way, *town_, *lanes_, lights_, traffic_);
    walker.gate = 0;
    walker.waited = walker.stuck = walker.lets = walker.let_for = 0;
    return true;
}

bool Crowd::is_near_friend(const Walker& walker, const Walker& leader, double distance) {
    return (leader.place.position - walker.place.position).head<2>().norm() < distance;
}

/// A new way, of those that the seed draws the first that leads somewhere; later if there is none.
void Crowd::plan(Walker& walker, std::uint64_t tick) {
    constexpr double nearest_goal = 40;  // [m]
    constexpr double farthest_goal = 300;
    constexpr int most_tries = 12;
    constexpr double in_sight = 20;  // [m]
    if (tick > 1 && ++plans_ > plans_a_tick)
        return;
    walker.gave_up = walker.person.jaywalks && walker.waited > patience_elsewhere;
    walker.way.clear();
    walker.gates.clear();
    walker.meets = false;
    const Walker* leader = walker.friend_of != 0 ? find(walker.friend_of) : nullptr;
    if (leader != nullptr && leader->down_until == 0) {
        if (leader->way.empty())
            return;
        const Eigen::Vector3d& there = leader->way.back().position;
        const bool is_there = (there - walker.place.position).norm() < 3;
        walker.meets = is_there && !is_near_friend(walker, *leader, in_sight);
        if (is_there && !walker.meets) {  // the other one comes
            walker.pause_until = tick + static_cast<std::uint64_t>(1 / step_);
            return;
        }
        const auto goal =
            map_of(walker.person).nearest(walker.meets ? leader->place.position : there);
        walker.person.side = leader->person.side - beside;
        if (goal && take_way(walker, *goal))
            return;
    }
    walker.friend_of = 0;
    walker.meets = false;
    const auto drawn = [&] {
        return world::draw(episode_->walker_seed, walker.draws++, Purpose::walker_goal, walker.id);
    };
    for (int i = 0; i < most_tries; ++i) {
        const double metre = drawn();
        const auto place = drawn_place(metre, drawn());
        if (!place)
            break;
        const double far = (*place - walker.place.position).head<2>().norm();
        if ((far < nearest_goal || far > farthest_goal) && i + 3 < most_tries)
            continue;
        const auto goal = map_of(walker.person).nearest(*place);
        if (goal && take_way(walker, *goal))
            return;
    }
    walker.pause_until = tick + static_cast<std::uint64_t>(5 / step_);
}

}  // namespace reprise::walkers
