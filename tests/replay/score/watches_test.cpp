// Each watch alone, on ticks that are made for it.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "replay/score/watch.h"
#include "tests/support/worlds.h"

namespace reprise::test {
namespace {

using replay::Infraction;
using replay::InfractionKind;

constexpr double step = 0.05;

/// A drive along the straight road, tick by tick, past the watches of a kind.
class Watched {
  public:
    explicit Watched(InfractionKind kind) : Watched(kind, kind) {}

    /// Two that come together.
    Watched(InfractionKind kind, InfractionKind other)
        : kind_(kind),
          other_(other),
          watches_(replay::all_watches(driven_)) {}

    /// One more tick, in which `change` says what is measured, and what else happens.
    void tick(const std::function<void(world::TickDraft&, world::Measurement&)>& change,
              double way = 0.5) {
        world::TickDraft draft;
        draft.tick.index = ++index_;
        x_ += way;
        world::VehicleState vehicle = vehicle_at(1, x_, -1.75);
        vehicle.mutate_odometer(x_);
        draft.tick.vehicles = {vehicle};
        world::Measurement measured;
        measured.mutate_actor(1);
        measured.mutate_speed(way / step);
        measured.mutate_lane(lane_);
        change(draft, measured);
        draft.tick.measurements = {measured};
        const world::SealedTick sealed = world::seal(draft, {});
        const world::TickView view = sealed.view();
        const replay::Sight sight =
            replay::see(view, view.vehicles()[0], view.measurements()[0], step, seen_);
        for (const auto& watch : watches_) {
            watch->look(sight);
            take(*watch);
        }
    }

    void ticks(int count,
               const std::function<void(world::Measurement&)>& change,
               double way = 0.5) {
        for (int i = 0; i < count; ++i)
            tick([&](world::TickDraft&, world::Measurement& measured) { change(measured); }, way);
    }

    /// Of the kind; others must not be there.
    std::vector<Infraction> finish() {
        for (const auto& watch : watches_) {
            watch->finish();
            take(*watch);
        }
        for (const Infraction& infraction : all_)
            EXPECT_TRUE(infraction.kind == kind_ || infraction.kind == other_)
                << name_of(infraction.kind);
        return all_;
    }

  private:
    void take(replay::Watch& watch) {
        for (const Infraction& infraction : watch.take())
            all_.push_back(infraction);
    }

    InfractionKind kind_;
    InfractionKind other_;
    world::TownT town_ = straight_road(400);
    replay::DrivenTown driven_{town_};
    std::uint32_t lane_ = 1;  ///< east_1
    std::vector<std::unique_ptr<replay::Watch>> watches_;
    replay::LastSeen seen_;
    std::uint64_t index_ = 0;
    double x_ = 20;
    std::vector<Infraction> all_;
};

void as_it_is(world::Measurement& /*measured*/) {}

TEST(Watches, SayNothingOfACleanDrive) {
    Watched drive(InfractionKind::blocked);
    drive.ticks(100, as_it_is);
    EXPECT_TRUE(drive.finish().empty());
}

/// 30 % are allowed; gaps below half a second belong to one episode.
TEST(Watches, ShareOfTheFootprintCountsAboveThirtyPercent) {
    for (const InfractionKind kind : {InfractionKind::sidewalk, InfractionKind::opposite_lane}) {
        const auto share = [&](double value) {
            return [kind, value](world::Measurement& measured) {
                if (kind == InfractionKind::sidewalk)
                    measured.mutate_on_sidewalk(value);
                else
                    measured.mutate_on_opposite_lane(value);
            };
        };
        Watched drive(kind);
        drive.ticks(10, share(0.3));
        drive.ticks(10, share(0.31));
        drive.ticks(8, share(0));
        drive.ticks(5, share(0.45));
        drive.ticks(11, share(0));
        drive.ticks(1, share(0.4));
        const auto found = drive.finish();
        ASSERT_EQ(found.size(), 2U) << name_of(kind);
        EXPECT_EQ(found[0].first, 11U);
        EXPECT_EQ(found[0].last, 33U);
        EXPECT_EQ(found[0].worst, 0.45);
        EXPECT_EQ(found[1].first, 45U);
        EXPECT_EQ(found[1].last, 45U);
    }
}

/// The road allows 13.89 m/s, and 3 km/h are what a speed meter may be off.
TEST(Watches, SpeedingBeginsBehindTheMetersError) {
    const double limit = straight_road(400).lanes.at(1).speed_limit;
    Watched within(InfractionKind::speeding);
    within.ticks(50, as_it_is, (limit + 0.8) * step);
    EXPECT_TRUE(within.finish().empty());
    Watched above(InfractionKind::speeding);
    above.ticks(50, as_it_is, (limit + 0.9) * step);
    const auto found = above.finish();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].worst, 0.9, 1e-9);
    EXPECT_EQ(found[0].last - found[0].first, 49U);
}

/// Five seconds, driving: who passes what stands in the way is faster. It is an opposite lane, too.
TEST(Watches, WrongWayLastsFiveSeconds) {
    const auto against = [](world::Measurement& measured) {
        measured.mutate_on_opposite_lane(0.51);
    };
    const auto wrong_ways = [&](int ticks, double way) {
        Watched drive(InfractionKind::wrong_way, InfractionKind::opposite_lane);
        drive.ticks(ticks, against, way);
        std::vector<Infraction> found = drive.finish();
        std::erase_if(found, [](const auto& one) { return one.kind != InfractionKind::wrong_way; });
        return found;
    };
    EXPECT_TRUE(wrong_ways(99, 0.5).empty());
    EXPECT_TRUE(wrong_ways(200, 0.02).empty()) << "0.4 m/s: it stands, more or less";
    ASSERT_EQ(wrong_ways(101, 0.5).size(), 1U);
    EXPECT_NEAR(wrong_ways(101, 0.5)[0].worst, 50, 0.6) << "metres";
}

TEST(Watches, BlockedIsAMinuteOfStanding) {
    Watched drive(InfractionKind::blocked);
    std::uint64_t halted = 0;
    const auto stand = [&](world::Measurement& measured) {
        measured.mutate_halted_ticks(++halted);
    };
    drive.ticks(10, as_it_is);
    drive.ticks(1199, stand, 0);
    drive.ticks(1, as_it_is);
    halted = 0;
    drive.ticks(1260, stand, 0);
    drive.ticks(1, as_it_is);
    const auto found = drive.finish();
    ASSERT_EQ(found.size(), 1U) << "59.95 s are none";
    EXPECT_EQ(found[0].first, 1211U) << "since it stood";
    EXPECT_EQ(found[0].last, 2470U);
    EXPECT_NEAR(found[0].worst, 63, 1e-9);
}

TEST(Watches, ACollisionIsAsLongAsItsEventsSay) {
    Watched drive(InfractionKind::collision_vehicle);
    drive.ticks(5, as_it_is);
    const auto told = [](world::EventKind kind, double impulse, double duration) {
        return [=](world::TickDraft& draft, world::Measurement&) {
            draft.tick.vehicles.push_back(vehicle_at(2, 100, -1.75));
            world::EventT event;
            event.kind = kind;
            event.actor = 2;  // it came into us: that counts as well
            event.other = 1;
            event.value = impulse;
            event.duration = duration;
            draft.tick.events.push_back(event);
        };
    };
    drive.tick(told(world::EventKind::collision, 900, 0));
    drive.ticks(10, as_it_is);
    drive.tick(told(world::EventKind::collision_ended, 2500, 0.25));
    const auto found = drive.finish();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].other, 2U);
    EXPECT_EQ(found[0].first, 6U);
    EXPECT_EQ(found[0].last, 10U) << "five ticks";
    EXPECT_EQ(found[0].worst, 2500);
}

}  // namespace
}  // namespace reprise::test
