#include "traffic/sight/meetings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/traffic/met_cars.h"
#include "traffic/cars/fleet.h"
#include "traffic/sight/foresight.h"
#include "traffic/sight/way_ahead.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {
namespace {

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

/// By the word of one look alone: it knows where it has to stop, and how far it has come.
TEST(Meetings, WhoIsHeldBackStopsWithoutAnotherLook) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const std::vector<Entry> entries = entries_of(town);
    constexpr double before = 9;  // [m]
    int held = 0;
    for (const Entry& one : entries)
        for (const Entry& other : entries) {
            if (graph.edge_of(one.first) == graph.edge_of(other.first) ||
                town.lanes[one.second].junction != town.lanes[other.second].junction)
                continue;
            Cars cars;
            world::TickDraft draft;
            cars.add(car_before(town, graph, 7, "sedan", one.first, one.second, before, 6),
                     "",
                     0,
                     draft);
            cars.add(
                car_before(town, graph, 8, "sedan", other.first, other.second, 0, 6), "", 0, draft);
            Meetings meetings(town, graph, right_of_way, meeting_step);
            meetings.keep(cars);
            EXPECT_FALSE(std::isfinite(meetings.allowed_speed(0)));
            meetings.look(cars, 2);
            if (!std::isfinite(meetings.allowed_speed(0)))
                continue;
            ++held;
            double driven = 0;  // [m]
            for (int i = 0; i < 200; ++i) {
                cars[0].speed = std::min(meetings.allowed_speed(0), cars[0].speed);
                driven += cars[0].speed * meeting_step;
                meetings.keep(cars);
            }
            EXPECT_LT(cars[0].speed, 0.1) << town.lanes[one.second].name;
            EXPECT_LT(driven, Foresight::look_ahead * (6 + Foresight::speeding_up));
            EXPECT_GT(driven, before / 2);
            cars[0].offset = 1.5;  // and who drives around something by now goes on with nothing
            meetings.keep(cars);
            EXPECT_FALSE(std::isfinite(meetings.allowed_speed(0)));
        }
    EXPECT_GT(held, 10);
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

/// Whoever lies in another one's body, by whatever went wrong before.
TEST(Meetings, WhoLiesInAnotherBodyGetsNoDeeperIntoIt) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const LaneLines lines(town);
    int deeper = 0, out = 0;
    for_pairs_inside(town, graph, {1, 1, 3}, [&](const Entry& one, const Entry& other, Cars& cars) {
        if (graph.edge_after(one.second) == graph.edge_after(other.second))
            return;
        const WayAhead way(cars[0], lines, graph, 20);
        const WayAhead its_way(cars[1], lines, graph, 20);
        const double now = depth(way.at(0), its_way.at(0));
        if (now < 0.02)
            return;
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
    });
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

/// Round a hairpin of a made-up map two of one row drove 1.6 m into each other, head on: who is
/// ahead on the way is looked after by SUMO, but not where that way comes back.
TEST(Meetings, WhoComesBackRoundAHairpinIsLetPastByThoseBehindHim) {
    TownT town = own_town("town1").town;
    const auto [lane, via] = entries_of(town).front();
    const world::LanePoint end = world::point_at(town.lanes[lane], town.lanes[lane].length);
    const auto place = [&](double ahead, double left) {
        const Eigen::Vector2d there = end.position.head<2>() + ahead * world::ahead_of(end.yaw) +
                                      left * world::left_of(end.yaw);
        return world::Vec3(there.x(), there.y(), end.position.z());
    };
    world::LaneT& hairpin = town.lanes[via];
    hairpin.centre = {place(0, 0), place(3, 0.2), place(3, 0.9), place(-17, 1)};
    hairpin.length = hairpin.sumo_length = 23.7;
    const RoadGraph graph = graph_for(town);
    Cars cars;
    world::TickDraft draft;
    Car ahead = car_before(town, graph, 7, "sedan", lane, via, 0, 3);
    ahead.lane = via;
    for (ahead.lane_position = 0; ahead.lane_position < 8; ahead.lane_position += 0.1)
        ahead.trail.advance(world::point_at(hairpin, ahead.lane_position).position);
    ahead.rear = ahead.trail.rear();
    const Eigen::Vector2d body = (ahead.trail.front() - ahead.rear).head<2>();
    ahead.turn_to(std::atan2(body.y(), body.x()));
    cars.add(std::move(ahead), "", 0, draft);
    cars.add(car_before(town, graph, 8, "sedan", lane, via, 8, 3), "", 0, draft);
    const RightOfWay right_of_way(town, {});
    Meetings meetings(town, graph, right_of_way, meeting_step);
    meetings.look(cars, 2);
    EXPECT_LT(meetings.allowed_speed(1), 3);
}

}  // namespace
}  // namespace reprise::traffic
