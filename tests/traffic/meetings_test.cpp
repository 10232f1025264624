#include "traffic/sight/meetings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "traffic/cars/fleet.h"
#include "traffic/sight/foresight.h"
#include "traffic/sight/way_ahead.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {
namespace {

using test::own_town;
using world::TownT;

constexpr double meeting_step = 0.05;

RoadGraph graph_for(const TownT& town) {
    return {town,
            std::vector<world::ClassSet>(town.lanes.size(), world::permitted("", "pedestrian"))};
}

/// Of SUMO, that far [m] before the end of a lane that leads into `via`, on its way through that.
Car car_before(const TownT& town,
               const RoadGraph& graph,
               std::uint32_t id,
               const char* model,
               std::uint32_t lane,
               std::uint32_t via,
               double before,
               double speed) {
    Car car;
    car.id = id;
    car.model = world::find_vehicle_model(model).value();
    car.sumo = "known";
    car.lane = lane;
    const world::LaneT& on = town.lanes[lane];
    car.lane_position = (on.length - before) / on.length * on.sumo_length;
    car.speed = speed;
    car.route = {graph.edge_of(lane), graph.edge_after(via)};
    const world::LanePoint at = world::point_at(on, on.length - before);
    car.turn_to(at.yaw);
    const Eigen::Vector3d ahead(std::cos(at.yaw), std::sin(at.yaw), 0);
    car.trail.start(at.position, -ahead, origin_to_front(car.model));
    car.rear = car.trail.rear();
    return car;
}

/// A lane and the one of a junction that it leads to.
using Entry = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Entry> entries_of(const TownT& town) {
    std::vector<Entry> entries;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (world::is_for_cars(town.lanes[i]) && town.lanes[i].kind != world::LaneKind::internal &&
            town.lanes[i].length > 25)
            for (const world::Link& link : town.lanes[i].links)
                if (link.via() != world::none)
                    entries.emplace_back(i, link.via());
    return entries;
}

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

/// Its bumper is in the left lane, where a queue stands; who comes on the right sees its tail.
TEST(Meetings, NobodyDrivesThroughTheTailOfWhoStandsBetweenTwoLanes) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const std::vector<Entry> entries = entries_of(town);
    int shown = 0;
    for (const Entry& entry : entries) {
        const std::uint32_t right = entry.first;
        const std::uint32_t via = entry.second;
        const std::uint32_t left = town.lanes[right].left;
        const auto yaw_before = [&](double metres) {
            const world::LaneT& lane = town.lanes[right];
            return world::point_at(lane, lane.length - metres).yaw;
        };
        if (left == world::none || town.lanes[right].length < 80 ||
            std::abs(yaw_before(60) - yaw_before(40)) > 0.01)
            continue;
        for (const double turned : {0.0, 0.3}) {
            Cars cars;
            world::TickDraft next;
            cars.add(car_before(town, graph, 7, "sedan", right, via, 60, 6), "", 0, next);
            Car standing = car_before(town, graph, 8, "minibus", left, via, 45, 0);
            standing.turn_to(standing.yaw + turned);
            standing.rear = standing.trail.front() -
                            origin_to_front(standing.model) *
                                Eigen::Vector3d(standing.ahead.x(), standing.ahead.y(), 0);
            cars.add(standing, "", 0, next);
            const RightOfWay right_of_way(town, {});
            Meetings meetings(town, graph, right_of_way, meeting_step);
            meetings.look(cars, 2);
            EXPECT_EQ(std::isfinite(meetings.allowed_speed(0)), turned > 0)
                << town.lanes[right].name;
        }
        ++shown;
    }
    EXPECT_GT(shown, 3);
}

/// The light of one has turned green when the other one is not out of the junction yet.
TEST(Meetings, WhoIsStillInTheJunctionIsLetOut) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const std::vector<Entry> entries = entries_of(town);
    int let_out = 0;
    for (const Entry& one : entries) {
        std::uint32_t last = one.second;  // behind the place where it waits, if there is one
        while (!town.lanes[last].links.empty() &&
               town.lanes[last].links.front().via() != world::none)
            last = town.lanes[last].links.front().via();
        if (town.lanes[last].length < 6)
            continue;
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) == graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            for (const double speed : {0.3, 1.5})
                for (const double to_line : {0.5, 2.0}) {
                    Cars cars;
                    world::TickDraft draft;
                    cars.add(
                        car_before(
                            town, graph, 7, "bus", last, last, town.lanes[last].length - 2, speed),
                        "",
                        0,
                        draft);
                    cars.add(car_before(
                                 town, graph, 8, "sedan", other.first, other.second, to_line, 2.5),
                             "",
                             0,
                             draft);
                    const RightOfWay right_of_way(town, {});
                    Meetings meetings(town, graph, right_of_way, meeting_step);
                    meetings.look(cars, 2);
                    EXPECT_FALSE(std::isfinite(meetings.allowed_speed(0)))
                        << town.lanes[last].name << " waits for who comes from "
                        << town.lanes[other.first].name;
                    let_out += std::isfinite(meetings.allowed_speed(1));
                }
        }
    }
    EXPECT_GT(let_out, 10);
}

/// Of two whose bodies would come into each other one waits, and only one.
TEST(Meetings, OneOfTwoWhoseWaysCrossWaits) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const LaneLines lines(town);
    const std::vector<Entry> entries = entries_of(town);
    int crossed = 0;
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            Cars cars;
            world::TickDraft draft;
            for (const auto& [id, entry] : {std::pair{7U, one}, std::pair{8U, other}})
                cars.add(car_before(town, graph, id, "sedan", entry.first, entry.second, 3, 6),
                         "",
                         0,
                         draft);
            // As they would drive on.
            bool would_touch = false;
            const WayAhead way(cars[0], lines, graph, 20);
            const WayAhead its_way(cars[1], lines, graph, 20);
            for (double driven = 0; driven < 14; driven += 0.25)
                would_touch |= overlap(way.at(driven), its_way.at(driven));
            const RightOfWay right_of_way(town, {});
            Meetings meetings(town, graph, right_of_way, meeting_step);
            meetings.look(cars, 2);
            const int waiting = static_cast<int>(std::isfinite(meetings.allowed_speed(0))) +
                                static_cast<int>(std::isfinite(meetings.allowed_speed(1)));
            if (would_touch) {
                ++crossed;
                EXPECT_EQ(waiting, 1)
                    << town.lanes[one.second].name << " and " << town.lanes[other.second].name;
            }
            // Whom it waits for is kept.
            EXPECT_EQ(cars[0].waits_for.size() + cars[1].waits_for.size(),
                      static_cast<std::size_t>(waiting));
        }
    EXPECT_GT(crossed, 10);
}

/// Demand takes rings of waiting cars for what they are; of one who passes something it would read
/// an old one.
TEST(Meetings, WhoTakesNoPartWaitsForNobody) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const Entry entry = entries_of(town).front();
    Cars cars;
    world::TickDraft draft;
    cars.add(car_before(town, graph, 7, "sedan", entry.first, entry.second, 3, 6), "", 0, draft);
    Meetings meetings(town, graph, right_of_way, meeting_step);
    cars[0].waits_for = cars[0].blocked_by = {9};
    cars[0].offset = 1.5;
    meetings.look(cars, 2);
    EXPECT_TRUE(cars[0].waits_for.empty());
    EXPECT_TRUE(cars[0].blocked_by.empty());
}

/// What was worked out for who stands is the same as if it were worked out anew: two routes.
TEST(Meetings, WhoStandsIsSeenAsIfHeWereSeenForTheFirstTime) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const std::vector<Entry> entries = entries_of(town);
    Meetings kept(town, graph, right_of_way, meeting_step);
    int held = 0;
    std::uint64_t tick = 1;
    const auto look = [&](const Cars& cars) {
        Cars its = cars;
        Cars anew = cars;
        kept.look(its, ++tick);
        Meetings fresh(town, graph, right_of_way, meeting_step);
        fresh.look(anew, tick);
        for (std::size_t i = 0; i < its.size(); ++i) {
            held += static_cast<int>(std::isfinite(fresh.allowed_speed(i)));
            EXPECT_EQ(kept.allowed_speed(i), fresh.allowed_speed(i)) << "car " << its[i].id;
            EXPECT_EQ(its[i].waits_for, anew[i].waits_for) << "car " << its[i].id;
        }
    };
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            // One stands at its line, the other one comes, stands and goes on; so does the first.
            for (const auto& [before, speed] : {std::pair{3.0, 0.0}, {3.0, 0.0}, {3.0, 5.0}})
                for (const double its_before : {8.0, 2.0, 2.0}) {
                    Cars cars;
                    world::TickDraft draft;
                    cars.add(
                        car_before(town, graph, 7, "sedan", one.first, one.second, before, speed),
                        "",
                        0,
                        draft);
                    const double its_speed = its_before > 2 ? 6 : 0;
                    cars.add(car_before(town,
                                        graph,
                                        8,
                                        "bus",
                                        other.first,
                                        other.second,
                                        its_before,
                                        its_speed),
                             "",
                             0,
                             draft);
                    look(cars);
                    // Who comes before the others in the order of ids takes nobody's place.
                    Cars more = cars;
                    more.add(car_before(town, graph, 5, "sedan", other.first, other.second, 20, 3),
                             "",
                             0,
                             draft);
                    look(more);
                    // Another way, from where it stands.
                    for (const Entry& third : entries)
                        if (third.first == one.first)
                            cars[0].route = {graph.edge_of(one.first),
                                             graph.edge_after(third.second)};
                    look(cars);
                }
        }
    EXPECT_GT(held, 100);
}

/// What the meetings of these cars come to.
struct Outcome {
    std::vector<double> allowed;
    std::vector<std::vector<std::uint32_t>> waits_for;
    std::vector<std::vector<std::uint32_t>> pushes_past;

    bool operator==(const Outcome&) const = default;
};

Outcome outcome_of(Meetings& meetings, Cars cars, std::uint64_t tick) {
    meetings.look(cars, tick);
    Outcome outcome;
    for (std::size_t i = 0; i < cars.size(); ++i) {
        outcome.allowed.push_back(meetings.allowed_speed(i));
        outcome.waits_for.push_back(cars[i].waits_for);
        outcome.pushes_past.push_back(cars[i].pushes_past);
    }
    return outcome;
}

/// Whatever happens to the cars after it looked ahead, it finds what one finds who did not.
TEST(Meetings, WhatWasForeseenHoldsUntilSomethingHappensToTheCars) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const std::vector<Entry> entries = entries_of(town);
    constexpr std::uint64_t tick = 100;
    world::TickDraft draft;
    Entry way;        // of the first car,
    Entry other_way;  // and of one who comes later
    const std::vector<std::function<void(Cars&)>> changes{
        [](Cars&) {},
        [](Cars& cars) { cars[1].speed = 1; },
        [](Cars& cars) { cars[1].lane_position -= 6; },
        [](Cars& cars) { cars[0].standing_ticks = cars[1].standing_ticks = 200; },
        [](Cars& cars) { cars[0].waits_for.clear(); },
        [](Cars& cars) {
            cars[0].pushes_past = {8};
            cars[0].pushes_until = tick + 50;
        },
        [](Cars& cars) { cars[1].offset = 2; },
        [](Cars& cars) { cars[1].pass = PassOrder{}; },
        [](Cars& cars) { cars[1].sumo.clear(); },
        [&](Cars& cars) { cars.remove(1, draft); },
        [&](Cars& cars) {
            cars.add(
                car_before(town, graph, 9, "sedan", way.first, way.second, 1, 0), "", 0, draft);
        },
        [&](Cars& cars) {
            cars[0].route = {graph.edge_of(way.first), graph.edge_after(other_way.second)};
        },
    };
    std::vector<int> mattered(changes.size(), 0);
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            way = other_way = one;
            for (const Entry& third : entries)
                if (third.first == one.first && third.second != one.second)
                    other_way = third;
            Cars cars;
            cars.add(
                car_before(town, graph, 7, "sedan", one.first, one.second, 5, 6), "", 0, draft);
            cars.add(
                car_before(town, graph, 8, "bus", other.first, other.second, 6, 6), "", 0, draft);
            cars[0].waits_for = {8};
            Meetings fresh(town, graph, right_of_way, meeting_step);
            const Outcome unchanged = outcome_of(fresh, cars, tick);
            for (std::size_t i = 0; i < changes.size(); ++i) {
                Meetings ahead(town, graph, right_of_way, meeting_step);
                ahead.look_ahead(cars.all(), tick);
                Cars later = cars;
                changes[i](later);
                Meetings anew(town, graph, right_of_way, meeting_step);
                const Outcome wanted = outcome_of(anew, later, tick);
                EXPECT_EQ(outcome_of(ahead, later, tick), wanted) << "change " << i;
                mattered[i] += static_cast<int>(wanted != unchanged);
            }
        }
    EXPECT_EQ(mattered.front(), 0);
    for (std::size_t i = 1; i < changes.size(); ++i)
        EXPECT_GT(mattered[i], 0) << "change " << i << " shows nothing";
}

/// In the junction, so far [m] along its lane, and there for long.
Car car_inside(
    const TownT& town, const RoadGraph& graph, std::uint32_t id, const Entry& entry, double s) {
    Car car = car_before(town, graph, id, "sedan", entry.first, entry.second, 1, 0);
    const world::LaneT& on = town.lanes[entry.second];
    for (double driven = -1; driven <= s; driven += 0.1)
        car.trail.advance(driven < 0 ? world::point_at(town.lanes[entry.first],
                                                       town.lanes[entry.first].length + driven)
                                           .position
                                     : world::point_at(on, driven).position);
    car.lane = entry.second;
    car.lane_position = s / on.length * on.sumo_length;
    car.rear = car.trail.rear();
    const Eigen::Vector2d body = (car.trail.front() - car.rear).head<2>();
    car.turn_to(std::atan2(body.y(), body.x()));
    car.standing_ticks = car.stuck_ticks = 200;
    return car;
}

/// Two that stand in each other's way: one gets past by a mirror's width for which the other one
/// waits, and through a body nobody drives. (What they would touch is worked out twice, once by
/// Foresight and once by a look at each half metre of the way.)
TEST(Meetings, OneOfTwoInEachOthersWayPushesPastAndNobodyPushesThrough) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const LaneLines lines(town);
    const std::vector<Entry> entries = entries_of(town);
    int past = 0, blocked = 0;
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            for (double s = 1; s < town.lanes[one.second].length - 1; s += 1)
                for (double its = 1; its < town.lanes[other.second].length - 1; its += 0.5) {
                    Cars cars;
                    world::TickDraft draft;
                    cars.add(car_inside(town, graph, 7, one, s), "", 0, draft);
                    cars.add(car_inside(town, graph, 8, other, its), "", 0, draft);
                    const WayAhead way(cars[0], lines, graph, 20);
                    const WayAhead its_way(cars[1], lines, graph, 20);
                    const auto deepest = [](const WayAhead& of, const BodyBox& standing) {
                        double found = 0;
                        for (double driven = 0; driven < 5; driven += 0.25)
                            found = std::max(found, depth(of.at(driven), standing));
                        return found;
                    };
                    if (overlap(way.at(0).widened(0.1), its_way.at(0)))
                        continue;
                    const double least =
                        std::min(deepest(way, its_way.at(0)), deepest(its_way, way.at(0)));
                    Meetings meetings(town, graph, right_of_way, meeting_step);
                    meetings.look(cars, 2);
                    const std::size_t pushing =
                        cars[0].pushes_past.size() + cars[1].pushes_past.size();
                    ASSERT_LE(pushing, 1U) << "both would";
                    if (least > 0.6) {
                        ++blocked;
                        ASSERT_EQ(pushing, 0U) << least << " m";
                    }
                    if (pushing == 0)
                        continue;
                    ++past;
                    const std::size_t who = cars[0].pushes_past.empty() ? 1 : 0;
                    ASSERT_LT(deepest(who == 0 ? way : its_way, (who == 0 ? its_way : way).at(0)),
                              0.5);
                    meetings.look(cars, 3);
                    EXPECT_TRUE(std::isinf(meetings.allowed_speed(who)));
                    EXPECT_EQ(meetings.allowed_speed(1 - who), 0);
                }
        }
    EXPECT_GT(past, 5);
    EXPECT_GT(blocked, 20);
}

/// The body, and all of its way, so many metres to the left.
double deepest_aside(const WayAhead& way, const BodyBox& standing, double left) {
    double found = 0;
    for (double driven = 0; driven < 5; driven += 0.25) {
        BodyBox body = way.at(driven);
        body.middle += left * world::turned_left(body.ahead);
        found = std::max(found, depth(body, standing));
    }
    return found;
}

TEST(Meetings, WhoPushesPastSteersAsideInItsLaneAndThenBackAgain) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const LaneLines lines(town);
    const std::vector<Entry> entries = entries_of(town);
    const double width = world::vehicle_models()[0].width;
    constexpr double sampled = 0.05;  // [m] that a look at each quarter of a metre may miss
    int to_the_left = 0, to_the_right = 0;
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            for (double s = 1; s < town.lanes[one.second].length - 1; s += 2)
                for (double its = 1; its < town.lanes[other.second].length - 1; its += 2) {
                    Cars cars;
                    world::TickDraft draft;
                    cars.add(car_inside(town, graph, 7, one, s), "", 0, draft);
                    cars.add(car_inside(town, graph, 8, other, its), "", 0, draft);
                    Meetings meetings(town, graph, right_of_way, meeting_step);
                    meetings.look(cars, 2);
                    if (cars[0].pushes_past.empty() && cars[1].pushes_past.empty()) {
                        ASSERT_FALSE(cars[0].offset_order || cars[1].offset_order);
                        continue;
                    }
                    const std::size_t who = cars[0].pushes_past.empty() ? 1 : 0;
                    Car& pusher = cars[who];
                    const WayAhead way(pusher, lines, graph, 20);
                    const BodyBox standing = WayAhead(cars[1 - who], lines, graph, 20).at(0);
                    const double straight_on = deepest_aside(way, standing, 0);
                    ASSERT_FALSE(cars[1 - who].offset_order);
                    if (!pusher.offset_order) {
                        ASSERT_LT(straight_on, sampled);
                        continue;
                    }
                    const double left = pusher.offset_order->change.to;
                    ASSERT_LE(std::abs(left) + width / 2, town.lanes[pusher.lane].width / 2 + 1e-9);
                    ASSERT_LT(deepest_aside(way, standing, left), std::max(straight_on, sampled));
                    ++(left > 0 ? to_the_left : to_the_right);
                    pusher.offset = left;
                    meetings.look(cars, pusher.pushes_until - 1);
                    ASSERT_EQ(pusher.offset_order->change.to, left);
                    pusher.standing_ticks = pusher.stuck_ticks = 0;
                    meetings.look(cars, pusher.pushes_until);
                    ASSERT_EQ(pusher.offset_order->change.to, 0);
                    ASSERT_EQ(pusher.offset_order->change.from, left);
                }
        }
    EXPECT_GT(to_the_left, 0);
    EXPECT_GT(to_the_right, 5);
}

/// Whoever lies in another one's body, by whatever went wrong before.
TEST(Meetings, WhoLiesInAnotherBodyGetsNoDeeperIntoIt) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const LaneLines lines(town);
    int deeper = 0, out = 0;
    for (const Entry& one : entries_of(town))
        for (const Entry& other : entries_of(town)) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction ||
                graph.edge_after(one.second) == graph.edge_after(other.second))
                continue;
            for (double s = 1; s < town.lanes[one.second].length - 3; s += 1)
                for (double its = 1; its < town.lanes[other.second].length - 3; its += 1) {
                    Cars cars;
                    world::TickDraft draft;
                    cars.add(car_inside(town, graph, 7, one, s), "", 0, draft);
                    cars.add(car_inside(town, graph, 8, other, its), "", 0, draft);
                    const WayAhead way(cars[0], lines, graph, 20);
                    const WayAhead its_way(cars[1], lines, graph, 20);
                    const double now = depth(way.at(0), its_way.at(0));
                    if (now < 0.02)
                        continue;
                    Meetings meetings(town, graph, right_of_way, meeting_step);
                    meetings.look(cars, 2);
                    for (const std::size_t who : {0U, 1U}) {
                        if (std::isfinite(meetings.allowed_speed(who)))
                            continue;
                        ++out;
                        const WayAhead& of = who == 0 ? way : its_way;
                        const BodyBox standing = (who == 0 ? its_way : way).at(0);
                        const double soon = depth(of.at(1.2), standing);
                        ASSERT_LT(soon, std::max(now + 0.1, 0.5)) << now << " m";
                    }
                    for (const std::size_t who : {0U, 1U})
                        deeper += meetings.allowed_speed(who) == 0;
                }
        }
    EXPECT_GT(deeper, 50);
    EXPECT_GT(out, 50);
}

/// As SUMO says it, whoever would be there first: it makes the other one wait.
TEST(Meetings, WhoLetsTheOtherGoInSumoWaits) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const std::vector<Entry> entries = entries_of(town);
    int crossed = 0;
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) >= graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            for (const std::size_t waits : {0U, 1U}) {
                Cars cars;
                world::TickDraft draft;
                for (const auto& [id, entry] : {std::pair{7U, one}, std::pair{8U, other}})
                    cars.add(car_before(town, graph, id, "sedan", entry.first, entry.second, 4, 6),
                             "",
                             0,
                             draft);
                RightOfWay::Firsts firsts(town.lanes.size());
                firsts[waits == 0 ? one.second : other.second] = {waits == 0 ? other.first
                                                                             : one.first};
                const RightOfWay right_of_way(town, firsts);
                Meetings meetings(town, graph, right_of_way, meeting_step);
                meetings.look(cars, 2);
                Foresight seen, its_seen;
                seen.look(cars[0], meetings.lines(), graph, 20);
                its_seen.look(cars[1], meetings.lines(), graph, 20);
                if (!seen.would_meet(its_seen) || !its_seen.would_meet(seen))
                    continue;
                ++crossed;
                EXPECT_FALSE(cars[waits].waits_for.empty())
                    << town.lanes[one.second].name << " and " << town.lanes[other.second].name;
            }
        }
    EXPECT_GT(crossed, 20);
}

/// SUMO loses the order of a lane's cars when a vehicle with mass overtakes them.
TEST(Meetings, NobodyDrivesIntoWhoIsAheadOnHisLane) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const auto [lane, via] = entries_of(town).front();
    Cars cars;
    world::TickDraft draft;
    cars.add(car_before(town, graph, 7, "sedan", lane, via, 19, 10), "", 0, draft);
    cars.add(car_before(town, graph, 8, "sedan", lane, via, 9, 1), "", 0, draft);
    const RightOfWay right_of_way(town, {});
    Meetings meetings(town, graph, right_of_way, meeting_step);
    meetings.look(cars, 2);
    EXPECT_LT(meetings.allowed_speed(0), 10);
    EXPECT_TRUE(std::isinf(meetings.allowed_speed(1)));
}

/// SUMO stops at his line who goes the other way of a fork, with his nose in who stands behind it.
TEST(Meetings, NobodyDrivesIntoWhoStandsBehindAFork) {
    const TownT& whole = own_town("town1").town;
    int looked_at = 0;
    for (const auto& [lane, via] : entries_of(whole)) {
        if (whole.lanes[via].length < 6 || whole.lanes[lane].links.front().via() != via)
            continue;
        ++looked_at;
        for (const bool forks : {false, true}) {
            TownT town = whole;
            auto& links = town.lanes[lane].links;
            links.resize(1);
            if (forks)
                links.push_back(links.front());
            const RoadGraph graph = graph_for(town);
            Cars cars;
            world::TickDraft draft;
            Car leader = car_before(town, graph, 7, "sedan", lane, via, 0, 0);
            const double length = world::vehicle_models()[leader.model].length;
            leader.lane = via;
            leader.lane_position = length + 0.1;
            const world::LanePoint at = world::point_at(town.lanes[via], leader.lane_position);
            leader.turn_to(at.yaw);
            leader.trail.advance(at.position);
            leader.rear = leader.trail.rear();
            cars.add(std::move(leader), "", 0, draft);
            cars.add(car_before(town, graph, 8, "sedan", lane, via, 1, 2), "", 0, draft);
            const RightOfWay right_of_way(town, {});
            Meetings meetings(town, graph, right_of_way, meeting_step);
            meetings.look(cars, 2);
            EXPECT_EQ(meetings.allowed_speed(1) < 2, forks) << town.lanes[via].name;
        }
        if (looked_at == 5)
            break;
    }
    EXPECT_EQ(looked_at, 5);
}

}  // namespace
}  // namespace reprise::traffic
