// The formulas, on examples that can be done by hand.
#include "replay/score/driving_score.h"

#include <cmath>

#include <gtest/gtest.h>

namespace reprise::test {
namespace {

using replay::driving_score;
using replay::Infraction;
using replay::InfractionKind;
using replay::Leaderboard;
using replay::LeaderboardCounts;
using replay::VehicleScore;

constexpr std::uint64_t step_ns = 50'000'000;

Infraction lasting(InfractionKind kind, std::uint64_t first, std::uint64_t last) {
    Infraction infraction;
    infraction.kind = kind;
    infraction.first = first;
    infraction.last = last;
    return infraction;
}

TEST(InfractionCount, TenSecondsOnTheSidewalkAreFive) {
    const auto count = [](std::uint64_t ticks) {
        return count_of(lasting(InfractionKind::sidewalk, 100, 99 + ticks), step_ns);
    };
    EXPECT_EQ(count(200), 5U);
    EXPECT_EQ(count(201), 6U);
    EXPECT_EQ(count(1), 1U);
    EXPECT_EQ(count(40), 1U);
    EXPECT_EQ(count(41), 2U);
}

TEST(InfractionCount, WhatHappensAtALineIsOne) {
    for (const InfractionKind kind :
         {InfractionKind::red_light, InfractionKind::stop_sign, InfractionKind::blocked})
        EXPECT_EQ(count_of(lasting(kind, 1, 400), step_ns), 1U) << name_of(kind);
}

TEST(DrivingScore, OfACleanDriveIsItsCompletion) {
    for (const Leaderboard each : {Leaderboard::multiplicative, Leaderboard::additive}) {
        EXPECT_EQ(driving_score(each, {}, 1.0).score, 100);
        EXPECT_DOUBLE_EQ(*driving_score(each, {}, 0.4).score, 40);
        EXPECT_EQ(driving_score(each, {}, {}).score, std::nullopt) << "no route";
        EXPECT_EQ(driving_score(each, {}, {}).penalty, 1);
    }
}

/// A pedestrian, two cars and a red light on 80 % of the route, a tenth of it off the lane.
TEST(DrivingScore, IsMadeAsTheLeaderboardSays) {
    LeaderboardCounts counts;
    counts.pedestrians = 1;
    counts.vehicles = 2;
    counts.red_lights = 1;
    counts.off_lane = 0.1;
    const auto older = driving_score(Leaderboard::multiplicative, counts, 0.8);
    EXPECT_NEAR(older.penalty, 0.126, 1e-12) << "0.50 x 0.60 x 0.60 x 0.70";
    EXPECT_NEAR(*older.completion, 0.72, 1e-12) << "0.8 x 0.9";
    EXPECT_NEAR(*older.score, 9.072, 1e-12);
    const auto newer = driving_score(Leaderboard::additive, counts, 0.8);
    EXPECT_NEAR(newer.penalty, 0.9 / 3.8, 1e-12) << "0.9 / (1 + 1.0 + 2 x 0.7 + 0.4)";
    EXPECT_NEAR(*newer.score, 80 * 0.9 / 3.8, 1e-12);
    ASSERT_EQ(newer.factors.size(), 5U);
    EXPECT_EQ(newer.factors[1].what, "vehicle");
    EXPECT_EQ(newer.factors[1].count, 2U);
    EXPECT_NEAR(newer.factors[1].value, 1.4, 1e-12);
}

TEST(RouteScore, IsDrivenFromNinetyNinePercentOnWhereTenMetresAreLeft) {
    EXPECT_EQ((replay::RouteScore{500, 0.995, 1, 0}.counted()), 1) << "2.5 m are left";
    EXPECT_EQ((replay::RouteScore{500, 0.98, 1, 0}.counted()), 0.98) << "10 m, but 98 %";
    EXPECT_EQ((replay::RouteScore{5000, 0.995, 1, 0}.counted()), 0.995) << "25 m are left";
}

/// As in the Leaderboard, whose route ends there.
TEST(LeaderboardCounts, EndWhereTheRouteEnds) {
    VehicleScore vehicle;
    vehicle.driven = 400;
    vehicle.off_lane = 300;
    vehicle.infractions = {lasting(InfractionKind::red_light, 100, 100),
                           lasting(InfractionKind::red_light, 4000, 4000)};
    EXPECT_EQ(leaderboard_counts(vehicle, step_ns).red_lights, 2U);
    vehicle.ended = {3700, 100, 10};
    EXPECT_EQ(leaderboard_counts(vehicle, step_ns).red_lights, 1U);
    EXPECT_DOUBLE_EQ(leaderboard_counts(vehicle, step_ns).off_lane, 0.1);
}

/// 5 m of the last one, whoever it was with; or 5 s, and the same one.
TEST(LeaderboardCounts, WhatIsNearTheLastCollisionIsThat) {
    VehicleScore vehicle;
    const auto hit = [&](std::uint32_t other, std::uint64_t tick, double x) {
        Infraction infraction = lasting(InfractionKind::collision_vehicle, tick, tick + 3);
        infraction.other = other;
        infraction.position.x() = x;
        vehicle.infractions.push_back(infraction);
    };
    hit(7, 100, 0);
    hit(7, 200, 8);
    EXPECT_EQ(leaderboard_counts(vehicle, step_ns).vehicles, 1U) << "the same one, 5 s later";
    hit(8, 900, 4);
    EXPECT_EQ(leaderboard_counts(vehicle, step_ns).vehicles, 1U) << "another one, 4 m away";
    hit(7, 901, 20);
    EXPECT_EQ(leaderboard_counts(vehicle, step_ns).vehicles, 2U) << "later and elsewhere";
    hit(8, 902, 26);
    EXPECT_EQ(leaderboard_counts(vehicle, step_ns).vehicles, 3U) << "somebody else, elsewhere";
    vehicle.driven = 200;
    vehicle.off_lane = 50;
    EXPECT_DOUBLE_EQ(leaderboard_counts(vehicle, step_ns).off_lane, 0.25);
}

}  // namespace
}  // namespace reprise::test
