#include "replay/compare/divergence.h"

#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>

#include "tests/replay/synthetic_run.h"
#include "tests/support/worlds.h"

namespace reprise::test {

namespace {

using replay::compare;
using replay::Divergence;
using testing::HasSubstr;

/// The difference of two ticks, one of which is changed.
Divergence difference(const Change& change, std::uint64_t index = 1) {
    const auto expected = drive({.ticks = index});
    const auto found = drive({.ticks = index, .change = at(index, change)});
    return compare(as_recorded(expected.back()), as_recorded(found.back())).value();
}

TEST(Compare, FindsNothingInEqualTicks) {
    const auto first = drive();
    const auto second = drive();
    for (std::size_t i = 0; i < first.size(); ++i)
        EXPECT_EQ(compare(as_recorded(first[i]), as_recorded(second[i])), std::nullopt);
}

TEST(Compare, NamesFieldValuesAndDistanceOfOneUnitInTheLastPlace) {
    double before = 0;
    const Divergence found = difference([&](world::TickDraft& draft) {
        world::Vec3& velocity = draft.tick.vehicles[0].mutable_velocity();
        before = velocity.x();
        velocity.mutate_x(std::nextafter(before, 100));
    });
    EXPECT_EQ(found.tick, 1u);
    EXPECT_EQ(found.stage, "physics");
    EXPECT_EQ(found.field, "vehicles[id 1].velocity.x");
    EXPECT_EQ(found.actor_id, 1u);
    EXPECT_EQ(std::strtod(found.expected.c_str(), nullptr), before);
    EXPECT_EQ(std::strtod(found.found.c_str(), nullptr), std::nextafter(before, 100));
    EXPECT_THAT(found.expected, HasSubstr("(0x402"));
    EXPECT_EQ(found.note, "1 unit in the last place apart");
}

TEST(Compare, NamesTheStageThatWroteTheField) {
    const auto stage = [](const Change& change) {
        const Divergence found = difference(change, 40);
        return found.stage + ": " + found.field;
    };
    using Draft = world::TickDraft;
    EXPECT_EQ(stage([](Draft& d) { d.tick.road_friction = 0.5; }), "scenario: road_friction");
    EXPECT_EQ(stage([](Draft& d) { d.tick.weather.mutate_rain(1); }), "scenario: weather.rain");
    EXPECT_EQ(stage([](Draft& d) { d.tick.controls[0].mutate_steer(0.5); }),
              "controls: controls[actor 1].steer");
    EXPECT_EQ(stage([](Draft& d) { d.tick.signals[0] = world::SignalColor::yellow; }),
              "traffic: signals[0]");
    EXPECT_EQ(stage([](Draft& d) { d.traffic.cars[3].mutate_yaw(1); }),
              "traffic: cars[id 1000003].yaw");
    EXPECT_EQ(stage([](Draft& d) { d.traffic.walkers.emplace_back(); }),
              "pedestrians: walkers[id 0]");
    EXPECT_EQ(stage([](Draft& d) { d.tick.wheels[2].mutate_rotation(1); }),
              "physics: wheels[vehicle 1, index 2].rotation");
    EXPECT_EQ(stage([](Draft& d) { d.tick.events[0].value = 1; }), "physics: events[0].value");
    EXPECT_EQ(stage([](Draft& d) { d.tick.measurements[0].mutate_gap_ahead(1); }),
              "measurements: measurements[actor 1].gap_ahead");
}

TEST(Compare, NamesTheFirstOfSeveralStages) {
    const Divergence found = difference([](world::TickDraft& draft) {
        draft.tick.measurements[0].mutate_speed(0);
        draft.tick.vehicles[0].mutate_odometer(1);
        draft.tick.controls[0].mutate_brake(1);
    });
    EXPECT_EQ(found.stage, "controls");
    EXPECT_EQ(found.field, "controls[actor 1].brake");
}

TEST(Compare, NamesAllDifferencesOfATickInTheOrderOfTheStages) {
    const auto expected = drive({.ticks = 1});
    const auto found = drive({.ticks = 1, .change = at(1, [](world::TickDraft& draft) {
                                              draft.tick.measurements[0].mutate_speed(0);
                                              draft.tick.vehicles[0].mutate_odometer(1);
                                              draft.tick.digests.mutate_physics(1);
                                              draft.tick.controls[0].mutate_brake(1);
                                          })});
    const auto names = [&](const std::optional<replay::Tolerance>& tolerance) {
        std::vector<std::string> all;
        for (const auto& [stage, field] : replay::all_differences(
                 as_recorded(expected.back()), as_recorded(found.back()), tolerance))
            all.push_back(stage + ": " + field.field);
        return all;
    };
    EXPECT_THAT(names({}),
                testing::ElementsAre("controls: controls[actor 1].brake",
                                     "physics: vehicles[id 1].odometer",
                                     "physics: digests.physics",
                                     "measurements: measurements[actor 1].speed"));
    EXPECT_THAT(names(replay::Tolerance{1e6}), testing::IsEmpty());
}

TEST(Compare, NamesActorsThatOnlyOneRunHas) {
    Divergence found =
        difference([](world::TickDraft& d) { d.traffic.cars.erase(d.traffic.cars.begin() + 2); });
    EXPECT_EQ(found.field, "cars[id 1000002]");
    EXPECT_EQ(found.expected, "present");
    EXPECT_EQ(found.found, "absent");
    found =
        difference([](world::TickDraft& d) { d.traffic.cars.push_back(car_at(1000009, 0, 0)); });
    EXPECT_EQ(found.field, "cars[id 1000009]");
    EXPECT_EQ(found.expected, "absent");
    EXPECT_EQ(found.actor_id, 1000009u);
}

TEST(Compare, AttributesAnEventThatOnlyOneRunHasToItsStage) {
    const Divergence found = difference([](world::TickDraft& draft) {
        world::EventT crash;
        crash.kind = world::EventKind::collision;
        crash.actor = 1;
        draft.tick.events.push_back(crash);
    });
    EXPECT_EQ(found.stage, "physics");
    EXPECT_EQ(found.field, "events[1]");
    EXPECT_EQ(found.expected, "absent");
    EXPECT_EQ(found.found, "collision");
}

TEST(Compare, NamesCommandsByTheirFields) {
    const auto with_speed = [](double speed) {
        return [=](world::TickDraft& draft) {
            world::CommandT command;
            command.kind = world::CommandKind::set_speed;
            command.actor = 1;
            command.speed = speed;
            draft.tick.commands.push_back(command);
        };
    };
    const auto expected = drive({.ticks = 1, .change = with_speed(10)});
    const auto found = drive({.ticks = 1, .change = with_speed(12.5)});
    const auto divergence = compare(as_recorded(expected[0]), as_recorded(found[0])).value();
    EXPECT_EQ(divergence.stage, "scenario");
    EXPECT_EQ(divergence.field, "commands[0].speed");
    EXPECT_THAT(divergence.found, HasSubstr("12.5 (0x4029"));
    EXPECT_EQ(divergence.actor, "actor 1");
}

TEST(Compare, SaysWhenTheDifferenceIsBelowTheRecordedPrecision) {
    const Divergence found = difference([](world::TickDraft& draft) {
        draft.tick.digests.mutate_traffic(draft.tick.digests.traffic() + 1);
    });
    EXPECT_EQ(found.stage, "traffic");
    EXPECT_EQ(found.field, "digests.traffic");
    EXPECT_THAT(found.note, HasSubstr("all recorded fields of this stage agree"));
}

TEST(BuildDifferences, AreTheLinesThatDifferOrAreMissing) {
    const auto lines = [](const std::vector<std::pair<std::string, std::string>>& pairs) {
        replay::Fingerprint print;
        for (const auto& [key, value] : pairs) {
            print.emplace_back();
            print.back().key = key;
            print.back().value = value;
        }
        return print;
    };
    const auto expected = lines({{"compiler", "GNU 12"}, {"sumo", "1.15.0"}, {"old", "1"}});
    const auto found = lines({{"new", "2"}, {"compiler", "GNU 13"}, {"sumo", "1.15.0"}});
    std::string text;
    for (const replay::BuildDifference& line : replay::build_differences(expected, found))
        text += line.key + " " + line.expected + " " + line.found + "\n";
    EXPECT_EQ(text, "compiler GNU 12 GNU 13\nold 1 -\nnew - 2\n");
    EXPECT_TRUE(replay::build_differences(expected, expected).empty());
}

TEST(DivergenceText, IsAFewLinesForAPerson) {
    Divergence found =
        difference([](world::TickDraft& draft) { draft.tick.controls[0].mutate_brake(0.5); });
    found.script = "tick 1 (0.05 s): spawn of ego (1), cut_in.lua:20";
    found.again = "reprise verify a.mcap";
    EXPECT_EQ(to_text(found, 50'000'000),
              "tick 1 (0.05 s), stage controls, actor 1\n"
              "  field     controls[actor 1].brake\n"
              "  expected  0 (0x0000000000000000)\n"
              "  found     0.5 (0x3fe0000000000000)\n"
              "  script    last said at tick 1 (0.05 s): spawn of ego (1), cut_in.lua:20\n"
              "  again     reprise verify a.mcap\n");
}

}  // namespace

}  // namespace reprise::test
