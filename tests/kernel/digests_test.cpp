// Each stage's digest covers all that the stage writes into the tick: what is left out of it could
// change without anybody noticing.
#include "kernel/digests.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "tests/kernel/whole_run.h"
#include "tests/support/worlds.h"

namespace reprise::kernel {

namespace {

using Change = std::function<void(world::TickDraft&)>;

world::EventT some_event() {
    world::EventT event;
    event.kind = world::EventKind::collision;
    event.actor = 1;
    event.other = 2;
    event.position = world::Vec3(1, 2, 3);
    event.value = 4;
    event.text = "text";
    event.detail = "detail";
    return event;
}

world::TickDraft some_tick() {
    world::TickDraft next;
    next.tick.index = 3;
    next.tick.signals = {world::SignalColor::red, world::SignalColor::green};
    next.tick.events = {some_event()};
    next.tick.measurements.resize(1);
    next.tick.looks = {world::Look(1, 5)};
    next.traffic.cars = {test::car_at(1'000'000, 10, 0)};
    next.traffic.looks = {world::Look(1'000'000, 5)};
    next.traffic.walkers.emplace_back(
        world::Vec3(1, 2, 0), 0.0F, 0.0F, 0.0F, 5U, std::uint16_t{0}, false, std::uint8_t{0}, 0U);
    return next;
}

/// Every change must show in the digest.
template <typename DigestOf>
void expect_all_seen(const DigestOf& digest_of_tick, const std::map<std::string, Change>& changes) {
    const std::uint64_t before = digest_of_tick(some_tick());
    EXPECT_EQ(before, digest_of_tick(some_tick()));
    for (const auto& [what, change] : changes) {
        world::TickDraft changed = some_tick();
        change(changed);
        EXPECT_NE(digest_of_tick(changed), before) << what;
    }
}

TEST(Digests, MeasurementsCoverEveryMeasurementAndEveryWordOfEveryEvent) {
    using Tick = world::TickDraft;
    expect_all_seen(
        digest_of_measurements,
        {{"speed", [](Tick& next) { next.tick.measurements[0].mutate_speed(1); }},
         {"gap", [](Tick& next) { next.tick.measurements[0].mutate_gap_ahead(1); }},
         {"halted", [](Tick& next) { next.tick.measurements[0].mutate_halted_ticks(1); }},
         {"kind", [](Tick& next) { next.tick.events[0].kind = world::EventKind::blocked; }},
         {"actor", [](Tick& next) { next.tick.events[0].actor = 7; }},
         {"other", [](Tick& next) { next.tick.events[0].other = 7; }},
         {"position", [](Tick& next) { next.tick.events[0].position = world::Vec3(1, 2, 4); }},
         {"value", [](Tick& next) { next.tick.events[0].value = 4.5; }},
         {"text", [](Tick& next) { next.tick.events[0].text = "other"; }},
         {"detail", [](Tick& next) { next.tick.events[0].detail = "other"; }},
         {"one more", [](Tick& next) { next.tick.events.push_back(some_event()); }},
         {"none", [](Tick& next) { next.tick.events.clear(); }}});
}

TEST(Digests, TrafficCoversCarsLooksAndSignals) {
    using Tick = world::TickDraft;
    const world::Recording recording = test::in_town1("wait(1)", 0, 1);
    const world::LaneMap lanes(recording.town);
    const traffic::Background background(
        recording.episode, recording.town, lanes, recording.network);
    expect_all_seen(
        [&](const Tick& next) { return digest_of(background, next); },
        {{"a signal", [](Tick& next) { next.tick.signals[0] = world::SignalColor::green; }},
         {"the last signal", [](Tick& next) { next.tick.signals[1] = world::SignalColor::red; }},
         {"a car", [](Tick& next) { next.traffic.cars[0] = test::car_at(1'000'000, 10.01, 0); }},
         {"a look", [](Tick& next) { next.traffic.looks[0] = world::Look(1'000'000, 6); }}});
}

TEST(Digests, PedestriansCoverEveryWalker) {
    using Tick = world::TickDraft;
    const world::Recording recording = test::in_town1("wait(1)", 0, 1);
    const world::LaneMap lanes(recording.town);
    const ground::GroundMesh ground = ground::build_ground(recording.town);
    const Pedestrians pedestrians(recording.episode, recording.town, lanes, ground);
    expect_all_seen([&](const Tick& next) { return digest_of(pedestrians, next); },
                    {{"position",
                      [](Tick& next) {
                          next.traffic.walkers[0].mutable_position() = {1, 2.5, 0};
                      }},
                     {"nobody", [](Tick& next) { next.traffic.walkers.clear(); }}});
}

TEST(Digests, TheScenariosCoversWeatherFrictionAndCommands) {
    using Tick = world::TickDraft;
    const world::Recording recording = test::in_town1("wait(1)", 0, 1);
    const world::LaneMap lanes(recording.town);
    const scripting::Scenario scenario(recording.episode, recording.town, lanes);
    expect_all_seen([&](const Tick& next) { return digest_of(scenario, next); },
                    {{"weather", [](Tick& next) { next.tick.weather.mutate_rain(1); }},
                     {"friction", [](Tick& next) { next.tick.road_friction = 0.5; }},
                     {"command", [](Tick& next) { next.tick.commands.emplace_back(); }}});
}

TEST(Digests, TheScenariosTellsApartTheWordsThatFewCommandsSay) {
    const world::Recording recording = test::in_town1("wait(1)", 0, 1);
    const world::LaneMap lanes(recording.town);
    const scripting::Scenario scenario(recording.episode, recording.town, lanes);
    const std::vector<std::function<void(world::CommandT&)>> changes{
        [](world::CommandT&) {},
        [](world::CommandT& one) { one.shape = world::Shape::linear; },
        [](world::CommandT& one) { one.on = true; },
        [](world::CommandT& one) { one.deceleration = 1; },
        [](world::CommandT& one) { one.has_pose = true; },
        [](world::CommandT& one) {
            one.has_pose = true;
            one.heading = 1;
        },
        [](world::CommandT& one) {
            one.path = {world::PathPoint({1, 0, 0}, 0, 0)};
        },
        [](world::CommandT& one) {
            one.path = {world::PathPoint({1, 0, 0}, 0, 1)};
        },
        [](world::CommandT& one) { one.signals = {1}; },
        [](world::CommandT& one) { one.color = world::SignalColor::red; },
        [](world::CommandT& one) { one.lamps = 1; },
        [](world::CommandT& one) { one.lamps_mask = 1; },
        [](world::CommandT& one) { one.doors = 1; },
    };
    std::vector<std::uint64_t> digests;
    for (const auto& change : changes) {
        world::TickDraft next = some_tick();
        change(next.tick.commands.emplace_back());
        digests.push_back(digest_of(scenario, next));
    }
    std::sort(digests.begin(), digests.end());
    EXPECT_EQ(std::adjacent_find(digests.begin(), digests.end()), digests.end());
}

TEST(Digests, TheScenariosCoversAllThatARigSays) {
    const world::Recording recording = test::in_town1("wait(1)", 0, 1);
    const world::LaneMap lanes(recording.town);
    const scripting::Scenario scenario(recording.episode, recording.town, lanes);
    const auto digest = [&](const std::function<void(world::CommandT&)>& change) {
        world::TickDraft next = some_tick();
        world::CommandT& command = next.tick.commands.emplace_back();
        command.rig.push_back(std::make_unique<world::SensorT>());
        change(command);
        return digest_of(scenario, next);
    };
    std::vector<std::uint64_t> digests{digest([](world::CommandT&) {})};
    digests.push_back(digest([](world::CommandT& one) { one.rig.clear(); }));
    digests.push_back(digest([](world::CommandT& one) { one.sees_sensors = true; }));
    const std::vector<std::function<void(world::SensorT&)>> changes{
        [](world::SensorT& sensor) { sensor.name = "front"; },
        [](world::SensorT& sensor) { sensor.kind = world::SensorKind::depth; },
        [](world::SensorT& sensor) { sensor.width = 84; },
        [](world::SensorT& sensor) { sensor.height = 84; },
        [](world::SensorT& sensor) { sensor.fov = 1; },
        [](world::SensorT& sensor) {
            sensor.position = {0, 0, 1};
        },
        [](world::SensorT& sensor) { sensor.yaw = 1; },
        [](world::SensorT& sensor) { sensor.pitch = 1; },
        [](world::SensorT& sensor) { sensor.every = 2; },
    };
    for (const auto& change : changes)
        digests.push_back(digest([&](world::CommandT& one) { change(*one.rig.front()); }));
    std::sort(digests.begin(), digests.end());
    EXPECT_EQ(std::adjacent_find(digests.begin(), digests.end()), digests.end());
}

}  // namespace

}  // namespace reprise::kernel
