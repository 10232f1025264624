#include "traffic/sight/way_ahead.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/traffic/met_cars.h"
#include "traffic/sight/foresight.h"

namespace reprise::traffic {
namespace {

/// Two routes that must agree: what is foretold, and a trail that is led along the lanes.
TEST(WayAhead, BodiesComeWhereTheirTrailWillLead) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const LaneLines lines(town);
    int turned = 0;
    for (const auto& [lane, via] : entries_of(town)) {
        const Car car = car_before(town, graph, 7, "bus", lane, via, 5, 4);
        Trail trail = car.trail;
        const WayAhead way(car, lines, graph, 16);
        const world::LaneT& on = town.lanes[lane];
        const world::LaneT& behind = town.lanes[via];
        for (double driven = 0.05; driven < 5 + behind.length && driven < 15; driven += 0.05) {
            const double s = on.length - 5 + driven;
            trail.advance(s < on.length ? world::point_at(on, s).position
                                        : world::point_at(behind, s - on.length).position);
            const Eigen::Vector2d body = (trail.front() - trail.rear()).head<2>();
            const BodyBox foretold = way.at(driven);
            ASSERT_LT(std::abs(world::cross(foretold.ahead, body.normalized())), 0.06)
                << on.name << " to " << behind.name << " after " << driven << " m";
            turned += std::abs(world::cross(world::ahead_of(car.yaw), foretold.ahead)) > 0.3;
        }
    }
    EXPECT_GT(turned, 100) << "no bend: nothing is shown";
}

/// Most pairs of cars are told apart by these two alone.
TEST(WayAhead, NoBodyLeavesItsAreaOrItsCorridor) {
    constexpr double reach = 20;
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const LaneLines lines(town);
    double narrowest = 1e9;
    for (const auto& [lane, via] : entries_of(town))
        for (const char* model : {"bus", "sedan", "bicycle"})
            for (const double beside : {0.0, 0.4}) {
                Car car = car_before(town, graph, 7, model, lane, via, 8, 4);
                car.trail.advance(car.trail.front() +
                                  beside * Eigen::Vector3d(-car.ahead.y(), car.ahead.x(), 0));
                car.rear = car.trail.rear() + Eigen::Vector3d(0, beside / 2, 0);
                const world::Box area = area_ahead(car, lines, graph, reach);
                const WayAhead way(car, lines, graph, reach + 1);
                const BodyBox corridor = way.corridor(reach, way.at(0).ahead);
                narrowest = std::min(narrowest, corridor.half_width);
                for (double driven = 0; driven < reach; driven += 0.25) {
                    const BodyBox body = way.at(driven);
                    for (const double along : {-1, 1})
                        for (const double across : {-1, 1}) {
                            const Eigen::Vector2d corner =
                                body.middle + along * body.half_length * body.ahead +
                                across * body.half_width * world::turned_left(body.ahead);
                            world::Box with = area;
                            with.take(corner);
                            ASSERT_TRUE(with.low == area.low && with.high == area.high)
                                << model << " on " << town.lanes[lane].name << " to "
                                << town.lanes[via].name << " after " << driven << " m";
                            const Eigen::Vector2d offset = corner - corridor.middle;
                            ASSERT_LE(std::abs(offset.dot(corridor.ahead)), corridor.half_length)
                                << model << " on " << town.lanes[lane].name << " to "
                                << town.lanes[via].name << " after " << driven << " m";
                            ASSERT_LE(std::abs(world::cross(corridor.ahead, offset)),
                                      corridor.half_width)
                                << model << " on " << town.lanes[lane].name << " to "
                                << town.lanes[via].name << " after " << driven << " m";
                        }
                }
            }
    EXPECT_LT(narrowest, 0.5) << "of a bicycle that drives straight on";
}

/// The same question, of every moment that is looked at.
bool meets_at_any_moment(const Car& one,
                         const WayAhead& way,
                         const Car& other,
                         const WayAhead& its_way) {
    for (const double speed :
         {std::max(one.speed, Foresight::least_speed), one.speed + Foresight::speeding_up})
        for (std::size_t i = 1; i < Foresight::samples; ++i) {
            const double seconds = Foresight::sample * static_cast<double>(i);
            if (overlap(way.at(speed * seconds).widened(Foresight::room),
                        its_way.at(other.speed * seconds)))
                return true;
        }
    return false;
}

/// [m] to the first place on the other's way, of every place that is looked at; none: -1.
double first_on_way(const WayAhead& way, const WayAhead& its_way, double reach) {
    for (double s = 0; s <= reach; s += Foresight::spacing)
        for (std::size_t i = 0; i < Foresight::samples; ++i)
            if (overlap(way.at(s).widened(Foresight::room),
                        its_way.at(reach / (Foresight::samples - 1) * static_cast<double>(i))))
                return s;
    return -1;
}

/// What is passed over because it is sure is what a look at everything would find.
TEST(Foresight, TellsWhatALookAtEveryMomentTells) {
    constexpr double reach = 26;
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const LaneLines lines(town);
    const std::vector<Entry> entries = entries_of(town);
    int met = 0, missed = 0;
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            for (const double speed : {0.0, 0.5, 4.0, 8.0}) {
                const Car car =
                    car_before(town, graph, 7, "bus", one.first, one.second, 1 + speed, speed);
                const Car its =
                    car_before(town, graph, 8, "sedan", other.first, other.second, 6, 7);
                Foresight seen, its_seen;
                seen.look(car, lines, graph, reach);
                its_seen.look(its, lines, graph, reach);
                const WayAhead way(car, lines, graph, reach + 1);
                const WayAhead its_way(its, lines, graph, reach + 1);
                const bool meets = meets_at_any_moment(car, way, its, its_way);
                (meets ? met : missed) += 1;
                ASSERT_EQ(seen.would_meet(its_seen), meets)
                    << town.lanes[one.second].name << " and " << town.lanes[other.second].name;
                ASSERT_EQ(its_seen.would_meet(seen), meets_at_any_moment(its, its_way, car, way));
                const Foresight::Entry first = seen.first_on_way_of(its_seen);
                ASSERT_EQ(first.is_any ? first.driven : -1, first_on_way(way, its_way, reach));
            }
        }
    EXPECT_GT(met, 50);
    EXPECT_GT(missed, 100);
}

}  // namespace
}  // namespace reprise::traffic
