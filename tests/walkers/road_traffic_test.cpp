#include "walkers/road_traffic.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "walkers/person.h"
#include "walkers/steering.h"
#include "world/models/carried.h"

namespace reprise::walkers {
namespace {

/// Somebody who wants over the straight road at x = 200, from south to north: east_1 first, whose
/// cars come from the west, then west_1.
class Crossing {
  public:
    Crossing()
        : town_(test::straight_road()),
          lanes_(town_),
          traffic_(town_, lanes_),
          conflicts(traffic_.conflicts({200, -3.5, 0}, {200, 3.5, 0})) {}

    /// Both lanes, at 1.4 m/s from the kerb.
    bool is_free(const std::vector<world::CarState>& cars,
                 Trust trust = Trust::none,
                 bool around_standing = false) {
        world::TickDraft tick;
        tick.traffic.cars = cars;
        const world::SealedTick last = world::seal(tick, {});
        users_.look(last.view(), step_);
        traffic_.look(users_.all());
        bool free = true;
        for (const Conflict& conflict : conflicts)
            free = free && traffic_.is_free(conflict,
                                            {(conflict.at - conflict.half_width) / 1.4,
                                             (conflict.at + conflict.half_width) / 1.4},
                                            trust,
                                            around_standing);
        return free;
    }

    /// It is seen there for so long.
    void stand(const world::CarState& car, double seconds) {
        step_ = 0.05;
        for (double time = 0; time < seconds; time += step_)
            is_free({car});
    }

    /// Eastwards on east_1, its front at `s`.
    world::CarState car(double s, double speed) const {
        world::CarState state = test::car_at(7, s - 4, -1.75, 0, speed);
        for (std::uint32_t i = 0; i < town_.lanes.size(); ++i)
            if (town_.lanes[i].name == "east_1")
                state.mutate_lane(i);
        state.mutate_lane_s(static_cast<float>(s));
        return state;
    }

  private:
    world::TownT town_;
    world::LaneMap lanes_;
    RoadTraffic traffic_;
    RoadUsers users_;
    double step_ = 0;  ///< [s]

  public:
    std::vector<Conflict> conflicts;
};

TEST(RoadTraffic, FindsTheLanesThatAWayCrosses) {
    const Crossing crossing;
    ASSERT_EQ(crossing.conflicts.size(), 2U);
    EXPECT_NEAR(crossing.conflicts[0].at, 1.75, 1e-6);
    EXPECT_NEAR(crossing.conflicts[1].at, 5.25, 1e-6);
    EXPECT_NEAR(crossing.conflicts[0].approaches[0].distance, 200, 1e-6);
}

/// Of the ways behind a crossing only the first was looked at: one ran into the flank of a bus that
/// took the second.
TEST(RoadTraffic, SeesATailOnTheWayWhereverTheCarTurnsBehindIt) {
    world::TownT town = test::straight_road(200);
    const auto first_behind = static_cast<std::uint32_t>(town.lanes.size());
    for (const double y : {10.0, -1.75, -10.0}) {
        world::LaneT lane = town.lanes[1];
        lane.kind = world::LaneKind::internal;
        lane.centre = {world::Vec3(200, -1.75, 0), world::Vec3(220, y, 0)};
        lane.length = std::hypot(20, y + 1.75);
        town.lanes.push_back(lane);
        town.lanes[1].links.emplace_back(static_cast<std::uint32_t>(town.lanes.size() - 1),
                                         world::none,
                                         0,
                                         world::Turn::straight,
                                         false,
                                         std::uint16_t{0});
    }
    const world::LaneMap lanes(town);
    const RoadTraffic traffic(town, lanes);
    const std::vector<Conflict> conflicts = traffic.conflicts({195, -3.5, 0}, {195, 0, 0});
    ASSERT_EQ(conflicts.size(), 1U);
    for (std::uint32_t lane = first_behind; lane < town.lanes.size(); ++lane) {
        const auto& seen = conflicts[0].approaches;
        const auto at = std::find_if(
            seen.begin(), seen.end(), [&](const auto& one) { return one.lane == lane; });
        ASSERT_NE(at, seen.end()) << lane - first_behind;
        EXPECT_NEAR(at->distance, -5, 1e-9);
    }
}

TEST(RoadTraffic, LetsNobodyStepInFrontOfACar) {
    Crossing crossing;
    EXPECT_TRUE(crossing.is_free({}));
    EXPECT_FALSE(crossing.is_free({crossing.car(170, 14)})) << "there in 2 s";
    EXPECT_TRUE(crossing.is_free({crossing.car(100, 14)})) << "there in 7 s";
    EXPECT_TRUE(crossing.is_free({crossing.car(215, 14)})) << "past";
    EXPECT_FALSE(crossing.is_free({crossing.car(201, 0)})) << "stands on it";
    EXPECT_TRUE(crossing.is_free({crossing.car(190, 0)})) << "stands before it";
    // As at the stop lines of small junctions, whose crossings are 0.9 m away.
    EXPECT_TRUE(crossing.is_free({crossing.car(199.3, 0)})) << "stands close before it";
    EXPECT_FALSE(crossing.is_free({crossing.car(199.7, 0)})) << "leaves no room";
}

TEST(RoadTraffic, WhoIsOnTheRoadWaitsForNoCarThatStands) {
    Crossing crossing;
    EXPECT_TRUE(crossing.is_free({crossing.car(201, 0)}, Trust::none, true)) << "on his way";
    EXPECT_TRUE(crossing.is_free({crossing.car(199.3, 0)}, Trust::none, true)) << "its nose is";
    EXPECT_FALSE(crossing.is_free({crossing.car(199.3, 2)}, Trust::none, true)) << "rolls";
}

TEST(RoadTraffic, AroundWhatHasStoodOnTheWayForLongOneWalks) {
    Crossing crossing;
    const auto for_seconds = [&](double seconds, const world::CarState& car) {
        crossing.stand(car, seconds);
        return crossing.is_free({car});
    };
    EXPECT_FALSE(for_seconds(8, crossing.car(201, 0))) << "it may drive on";
    EXPECT_TRUE(for_seconds(8, crossing.car(201, 0))) << "it waits, perhaps for us";
    EXPECT_FALSE(for_seconds(1, crossing.car(204, 1))) << "it drives";
}

TEST(RoadTraffic, WhoTrustsInBrakesGoesWhereACarCanStop) {
    Crossing crossing;
    EXPECT_FALSE(crossing.is_free({crossing.car(180, 8)}));
    EXPECT_TRUE(crossing.is_free({crossing.car(180, 8)}, Trust::all)) << "by 1.8 m/s2";
    EXPECT_FALSE(crossing.is_free({crossing.car(180, 14)}, Trust::all)) << "by 5 m/s2";
    EXPECT_FALSE(crossing.is_free({crossing.car(180, 8)}, Trust::seen)) << "does not brake";
    world::CarState braking = crossing.car(180, 8);
    braking.mutate_acceleration(-1);
    EXPECT_TRUE(crossing.is_free({braking}, Trust::seen));
}

TEST(Person, IsDrawnOnceAndWhoLooksAtAPhoneIsSlower) {
    double on_phone = 0;
    double others = 0;
    int phones = 0;
    int jaywalkers = 0;
    constexpr std::uint32_t people = 4000;
    for (std::uint32_t id = 1; id <= people; ++id) {
        const Person person = draw_person(5, id, 0.25);
        EXPECT_EQ(person.speed, draw_person(5, id, 0.25).speed);
        const world::WalkerModel& model = world::walker_models()[person.model];
        EXPECT_GT(person.speed, 0.4);
        EXPECT_LT(person.speed, 4);
        const double pace = person.speed / model.walking_speed;
        const bool phone = world::carried_by(model, person.look).phone;
        phones += phone;
        jaywalkers += person.jaywalks;
        (phone ? on_phone : others) += pace;
    }
    EXPECT_NEAR(jaywalkers, people / 4, 100);
    ASSERT_GT(phones, 100);
    EXPECT_LT(on_phone / phones, 0.9 * others / (people - phones));
}

TEST(Steering, GoesAroundWhoComesTowardsIt) {
    Steering steering;
    const Body self{{0, 0}, {1.4, 0}, 0.25, 1};
    const std::vector<Body> ahead{{{3, 0}, {-1.4, 0}, 0.25, 2}};
    const Eigen::Vector2d chosen = steering.choose(self, {1.4, 0}, ahead);
    EXPECT_GT(std::abs(chosen.y()), 0.2);
    EXPECT_EQ(chosen, steering.choose(self, {1.4, 0}, ahead)) << "keeps nothing";
    const Eigen::Vector2d alone = steering.choose(self, {1.4, 0}, {});
    EXPECT_NEAR((alone - Eigen::Vector2d(1.4, 0)).norm(), 0, 0.05);
}

TEST(Steering, UsesOurMaths) {
    EXPECT_TRUE(detour_uses_our_maths());
}

}  // namespace
}  // namespace reprise::walkers
