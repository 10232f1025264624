#include "traffic/sight/pushing_past.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/traffic/met_cars.h"
#include "traffic/sight/meetings.h"
#include "traffic/sight/way_ahead.h"

namespace reprise::traffic {
namespace {

/// Two that stand in each other's way: one gets past by a mirror's width for which the other one
/// waits, and through a body nobody drives. (What they would touch is worked out twice, once by
/// Foresight and once by a look at each half metre of the way.)
TEST(PushingPast, OneOfTwoInEachOthersWayPushesPastAndNobodyPushesThrough) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const LaneLines lines(town);
    int past = 0, blocked = 0;
    for_pairs_inside(town, graph, {1, 0.5, 1}, [&](const Entry&, const Entry&, Cars& cars) {
        const WayAhead way(cars[0], lines, graph, 20);
        const WayAhead its_way(cars[1], lines, graph, 20);
        const auto deepest = [](const WayAhead& of, const BodyBox& standing) {
            double found = 0;
            for (double driven = 0; driven < 5; driven += 0.25)
                found = std::max(found, depth(of.at(driven), standing));
            return found;
        };
        if (overlap(way.at(0).widened(0.1), its_way.at(0)))
            return;
        const double least = std::min(deepest(way, its_way.at(0)), deepest(its_way, way.at(0)));
        Meetings meetings(town, graph, right_of_way, meeting_step);
        meetings.look(cars, 2);
        const std::size_t pushing = cars[0].pushes_past.size() + cars[1].pushes_past.size();
        ASSERT_LE(pushing, 1U) << "both would";
        if (least > 0.6) {
            ++blocked;
            ASSERT_EQ(pushing, 0U) << least << " m";
        }
        if (pushing == 0)
            return;
        ++past;
        const std::size_t who = cars[0].pushes_past.empty() ? 1 : 0;
        ASSERT_LT(deepest(who == 0 ? way : its_way, (who == 0 ? its_way : way).at(0)), 0.5);
        meetings.look(cars, 3);
        EXPECT_TRUE(std::isinf(meetings.allowed_speed(who)));
        EXPECT_EQ(meetings.allowed_speed(1 - who), 0);
    });
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

/// Is the other one beside its rear where it lies deepest in it?
bool is_beside_rear(const WayAhead& way, const BodyBox& standing) {
    double found = 0;
    bool behind = false;
    for (double driven = 0; driven < 5; driven += 0.1) {
        const BodyBox body = way.at(driven);
        if (depth(body, standing) <= found)
            continue;
        found = depth(body, standing);
        behind = body.ahead.dot(standing.middle - body.middle) < 0;
    }
    return behind;
}

/// But not where that would swing its tail into the other one.
TEST(PushingPast, WhoPushesPastSteersAsideInItsLaneAndThenBackAgain) {
    const TownT& town = own_town("town1").town;
    const RoadGraph graph = graph_for(town);
    const RightOfWay right_of_way(town, {});
    const LaneLines lines(town);
    const double width = world::vehicle_models()[0].width;
    constexpr double sampled = 0.05;  // [m] that a look at each quarter of a metre may miss
    int to_the_left = 0, to_the_right = 0;
    for_pairs_inside(town, graph, {2, 2, 1}, [&](const Entry&, const Entry&, Cars& cars) {
        Meetings meetings(town, graph, right_of_way, meeting_step);
        meetings.look(cars, 2);
        if (cars[0].pushes_past.empty() && cars[1].pushes_past.empty()) {
            ASSERT_FALSE(cars[0].offset_order || cars[1].offset_order);
            return;
        }
        const std::size_t who = cars[0].pushes_past.empty() ? 1 : 0;
        Car& pusher = cars[who];
        const WayAhead way(pusher, lines, graph, 20);
        const BodyBox standing = WayAhead(cars[1 - who], lines, graph, 20).at(0);
        const double straight_on = deepest_aside(way, standing, 0);
        ASSERT_FALSE(cars[1 - who].offset_order);
        if (!pusher.offset_order) {
            ASSERT_TRUE(straight_on < sampled || is_beside_rear(way, standing));
            return;
        }
        ASSERT_TRUE(straight_on < sampled || !is_beside_rear(way, standing));
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
    });
    EXPECT_GT(to_the_left, 0);
    EXPECT_GT(to_the_right, 3);
}

}  // namespace
}  // namespace reprise::traffic
