#include "world/story/crashes.h"

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace reprise::world {
namespace {

/// A sedan 1 behind hatchback 1000012 of the demand, and one event.
struct Scene {
    std::vector<Crash> hear(EventKind kind, double value, double duration, std::uint32_t other) {
        TickDraft draft;
        draft.tick.index = ++index;
        if (index == 1) {
            draft.tick.events.push_back(spawned(1, "ego"));
            draft.tick.events.push_back(spawned(1'000'012, "hatchback"));
        }
        draft.tick.vehicles = {test::vehicle_at(1, 0, 0, 0, ego_speed)};
        draft.traffic.cars = {test::car_at(1'000'012, 5, 0, 0, car_speed)};
        if (kind != EventKind::printed) {
            EventT event;
            event.kind = kind;
            event.actor = 1;
            event.other = other;
            event.value = value;
            event.duration = duration;
            draft.tick.events.push_back(event);
        }
        const SealedTick sealed = seal(draft, {});
        return story.hear(sealed.view());
    }

    static EventT spawned(std::uint32_t actor, const char* text) {
        EventT event;
        event.kind = EventKind::spawned;
        event.actor = actor;
        event.text = text;
        return event;
    }

    std::vector<Crash> hear_nothing() { return hear(EventKind::printed, 0, 0, 0); }

    double ego_speed = 10;
    double car_speed = 2;
    std::uint64_t index = 0;
    CrashStory story;
};

}  // namespace

TEST(CrashStory, IsOneLineWithNamesSpeedWorstImpulseAndDuration) {
    Scene scene;
    scene.hear_nothing();
    EXPECT_TRUE(scene.hear(EventKind::collision, 8000, 0, 1'000'012).empty());
    scene.hear_nothing();
    const auto ended = scene.hear(EventKind::collision_ended, 12300, 0.85, 1'000'012);
    ASSERT_EQ(ended.size(), 1U);
    EXPECT_EQ(ended[0].tick, 2U);
    EXPECT_EQ(
        to_line(ended[0]),
        "ego hits a passing hatchback (1000012) at 8.0 m/s: 12,300 N s, in contact for 0.85 s");
    EXPECT_TRUE(scene.story.open().empty());
}

TEST(CrashStory, WhoComesCloserHits) {
    Scene scene;
    scene.ego_speed = -1;
    scene.car_speed = -6;
    scene.hear_nothing();
    scene.hear(EventKind::collision, 500, 0, 1'000'012);
    ASSERT_EQ(scene.story.open().size(), 1U);
    EXPECT_EQ(to_line(scene.story.open()[0]),
              "a passing hatchback (1000012) hits ego at 5.0 m/s: 500 N s");
}

TEST(CrashStory, TheStaticWorldIsSomethingFixed) {
    Scene scene;
    scene.hear_nothing();
    scene.hear(EventKind::collision, 500, 0, 0);
    EXPECT_EQ(to_line(scene.story.open().at(0)), "ego hits something fixed at 10.0 m/s: 500 N s");
}

TEST(CrashStory, WithoutTheTickBeforeItTellsNoSpeed) {
    Scene scene;
    scene.hear(EventKind::collision, 0, 0, 1'000'012);
    EXPECT_EQ(to_line(scene.story.open().at(0)), "ego hits a passing hatchback (1000012)");
}

TEST(ActorNames, OfThoseWhoWereNotHeardAreTheirIds) {
    const ActorNames names;
    EXPECT_EQ(names.name_of(7), "actor 7");
}

}  // namespace reprise::world
