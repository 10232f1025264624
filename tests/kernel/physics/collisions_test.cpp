#include "kernel/physics/collisions.h"

#include <gtest/gtest.h>

namespace reprise::kernel {
namespace {

constexpr std::uint64_t step_ns = 50'000'000;

/// Feeds impulses tick by tick.
struct Touches {
    std::vector<world::EventT> tick(double impulse, bool is_last = false, std::uint32_t other = 7) {
        collisions.clear();
        if (impulse > 0)
            collisions.add(1, other, impulse, btVector3(static_cast<double>(index), 0, 0));
        std::vector<world::EventT> events;
        collisions.write(++index, is_last, events);
        return events;
    }

    std::uint64_t digest() const {
        world::Hasher hasher;
        collisions.add_to(hasher);
        return hasher.digest64();
    }

    Collisions collisions{step_ns};
    std::uint64_t index = 0;
};

TEST(Collisions, AContactThatGoesOnIsOneEventAtItsBeginAndOneAtItsEnd) {
    Touches touches;
    ASSERT_EQ(touches.tick(100).size(), 1U);
    EXPECT_TRUE(touches.tick(900).empty());
    EXPECT_TRUE(touches.tick(300).empty());
    for (int tick = 0; tick < 9; ++tick)
        ASSERT_TRUE(touches.tick(0).empty()) << tick;
    const auto ended = touches.tick(0);  // half a second behind the last touch
    ASSERT_EQ(ended.size(), 1U);
    EXPECT_EQ(ended[0].kind, world::EventKind::collision_ended);
    EXPECT_EQ(ended[0].actor, 1U);
    EXPECT_EQ(ended[0].other, 7U);
    EXPECT_EQ(ended[0].value, 900) << "the worst tick's";
    EXPECT_EQ(ended[0].position.x(), 1) << "where that was";
    EXPECT_DOUBLE_EQ(ended[0].duration, 3 * 0.05);
    EXPECT_TRUE(touches.tick(0).empty());
}

TEST(Collisions, BeginsWithTheImpulseOfItsFirstTick) {
    Touches touches;
    const auto begun = touches.tick(100);
    ASSERT_EQ(begun.size(), 1U);
    EXPECT_EQ(begun[0].kind, world::EventKind::collision);
    EXPECT_EQ(begun[0].value, 100);
    EXPECT_EQ(begun[0].duration, 0);
}

TEST(Collisions, ShorterGapsThanHalfASecondBelongToTheContact) {
    for (const int gap : {9, 10}) {
        Touches touches;
        std::size_t begun = touches.tick(50).size();
        for (int tick = 1; tick < gap; ++tick)
            touches.tick(0);
        for (const world::EventT& event : touches.tick(50))
            begun += event.kind == world::EventKind::collision ? 1 : 0;
        EXPECT_EQ(begun, gap == 9 ? 1U : 2U) << gap << " ticks of 0.05 s";
    }
}

TEST(Collisions, TheRunsLastTickEndsWhatIsOpenAlsoWhatBeginsInIt) {
    Touches touches;
    touches.tick(100);
    const auto last = touches.tick(40, true, 9);
    ASSERT_EQ(last.size(), 3U);
    EXPECT_EQ(last[0].kind, world::EventKind::collision);
    EXPECT_EQ(last[1].kind, world::EventKind::collision_ended);
    EXPECT_EQ(last[1].other, 7U);
    EXPECT_EQ(last[2].kind, world::EventKind::collision_ended);
    EXPECT_EQ(last[2].other, 9U);
    EXPECT_TRUE(touches.tick(0).empty());
}

TEST(Collisions, ImpulsesOfEveryTickAreToldToTheMeasurements) {
    Touches touches;
    double sum = 0;
    for (const double impulse : {100.0, 900.0, 0.0, 300.0}) {
        touches.tick(impulse);
        for (const Impact& impact : touches.collisions.impacts())
            sum += impact.impulse;
    }
    EXPECT_EQ(sum, 1300);
}

TEST(Collisions, DigestTellsContactsThatDifferInTheirPastOnly) {
    Touches one;
    Touches other;
    EXPECT_EQ(one.digest(), other.digest());
    one.tick(100);
    other.tick(101);
    one.tick(50);
    other.tick(50);
    EXPECT_NE(one.digest(), other.digest());
    Touches never;
    never.tick(0);
    never.tick(0);
    for (int tick = 0; tick < 20; ++tick)
        one.tick(0);
    EXPECT_EQ(one.digest(), never.digest()) << "nothing is left of a contact that is over";
}

}  // namespace
}  // namespace reprise::kernel
