// Background walkers in whole runs: live, recorded and made again.
#include <filesystem>
#include <unistd.h>

#include <gtest/gtest.h>

#include "kernel/verify.h"
#include "replay/trace_writer.h"
#include "tests/kernel/whole_run.h"
#include "tests/support/foot_traffic.h"
#include "tests/support/one_processor.h"
#include "walkers/crowd.h"

namespace reprise::test {

namespace {

world::Recording street_life(unsigned walkers, double seconds, unsigned cars = 20) {
    world::Recording recording = in_town1(
        "spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' } wait(600)", cars, seconds);
    recording.episode.walkers = walkers;
    recording.episode.walker_seed = 5;
    recording.episode.jaywalkers = 0.2;
    return recording;
}

TEST(CrowdRuns, VerifyFindsNothingInARunOfAHundredWalkers) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("reprise_crowd_" + std::to_string(getpid()) + ".mcap");
    const world::Recording recording = street_life(100, 30);
    std::vector<KeptTick> live;
    {
        replay::TraceWriter trace(path, recording);
        kernel::Kernel kernel(recording);
        while (!kernel.finished()) {
            const world::SealedTick& tick = kernel.step();
            trace.append(tick);
            live.emplace_back(tick);
        }
        trace.close(kernel.outcome());
    }
    replay::TraceReader trace(path);
    ASSERT_EQ(trace.ticks(), 600U);
    EXPECT_EQ(kernel::verify(trace), std::nullopt);
    // Replay is live: the bytes of each tick.
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index) {
        const replay::RecordedTick replayed = trace.recorded(index);
        const replay::RecordedTick seen = live[index - 1].recorded();
        ASSERT_EQ(replayed.view.walkers().size(), 100U);
        ASSERT_TRUE(std::ranges::equal(replayed.traffic_bytes, seen.traffic_bytes)) << index;
    }
    std::filesystem::remove(path);
}

/// Where there are two processors traffic and those on foot make their steps at once, drivers
/// decide meanwhile, and cars look ahead to the next step; where nobody walks they look while SUMO
/// makes its step.
TEST(CrowdRuns, OneProcessorMakesTheRunThatSeveralMake) {
    for (const unsigned walkers : {60u, 0u}) {
        const auto chain_of = [&] {
            return world::to_hex(
                run(street_life(walkers, 20, 80)).back().recorded().view.tick->digests()->chain());
        };
        const std::string several = chain_of();
        const OneProcessor alone;
        EXPECT_EQ(chain_of(), several) << walkers << " walkers";
    }
}

TEST(CrowdRuns, WhereNobodyWalksTheOtherNumbersChangeNothing) {
    world::Recording none = street_life(0, 2);
    world::Recording plain = none;
    plain.episode.walker_seed = 0;
    plain.episode.jaywalkers = 0;
    const std::vector<KeptTick> one = run(none);
    const std::vector<KeptTick> other = run(plain);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        const auto& here = one[i].recorded();
        const auto& there = other[i].recorded();
        ASSERT_TRUE(std::ranges::equal(here.traffic_bytes, there.traffic_bytes));
        // The chains differ: they begin with all numbers of the episode.
        ASSERT_TRUE(world::to_hex(here.view.tick->digests()->state()) ==
                    world::to_hex(there.view.tick->digests()->state()));
    }
}

/// Of a minute in a town full of cars, as recorded, by SUMO's lights.
TEST(CrowdRuns, NobodyIsHitAndEverybodyKeepsToTheRulesAmongAHundredCars) {
    world::Recording recording =
        in_town1("spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' } wait(600)", 100, 60);
    recording.episode.walkers = 100;
    recording.episode.walker_seed = recording.episode.seed = 7;
    recording.episode.jaywalkers = 0.1;
    const world::LaneMap lanes(recording.town);
    FootTraffic people(recording.town, lanes, 0.05);
    for (const KeptTick& tick : run(recording)) {
        const replay::RecordedTick recorded = tick.recorded();
        people.see(recorded.view);
        if (recorded.view.tick->events() == nullptr)
            continue;
        for (const world::Event* event : *recorded.view.tick->events())
            EXPECT_FALSE(event->kind() == world::EventKind::collision &&
                         event->other() >= walkers::first_walker_id)
                << event->actor() << " hits " << event->other() << " in tick "
                << recorded.view.index();
    }
    EXPECT_EQ(people.walker_ticks, 100U * 1200U);
    for (const FootTraffic::Count* none : {&people.in_cars,
                                           &people.hit,
                                           &people.in_obstacles,
                                           &people.in_others,
                                           &people.jumps,
                                           &people.at_red,
                                           &people.without_gap})
        EXPECT_EQ(none->times, 0U) << people.text();
    EXPECT_GT(people.at_green, 10U) << people.text();
    EXPECT_GT(people.elsewhere, 0U) << people.text();
    // Only those cross elsewhere who were drawn to.
    for (const std::uint32_t id : people.who_crossed_elsewhere)
        EXPECT_TRUE(walkers::draw_person(7, id, 0.1).jaywalks ||
                    walkers::draw_person(7, id - 1, 0.1).jaywalks)  // a friend of that one
            << id;
}

/// Where everybody crosses anywhere cars brake, people look, and nobody is hit; where nobody does,
/// nobody is on the road but on crossings.
TEST(CrowdRuns, WhoCrossesAnywhereIsNotHitAndNobodyDoesWhereNobodyIsTo) {
    world::Recording recording =
        in_town1("spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' } wait(600)", 60, 60);
    recording.episode.walkers = 60;
    recording.episode.walker_seed = recording.episode.seed = 11;
    const world::LaneMap lanes(recording.town);
    for (const double share : {0.0, 1.0}) {
        recording.episode.jaywalkers = share;
        FootTraffic people(recording.town, lanes, 0.05);
        for (const KeptTick& tick : run(recording))
            people.see(tick.recorded().view);
        for (const FootTraffic::Count* none : {&people.in_cars,
                                               &people.hit,
                                               &people.in_obstacles,
                                               &people.in_others,
                                               &people.at_red,
                                               &people.without_gap})
            EXPECT_EQ(none->times, 0U) << share << "\n" << people.text();
        if (share == 0)
            EXPECT_EQ(people.elsewhere, 0U) << people.text();
        else
            EXPECT_GT(people.who_crossed_elsewhere.size(), 10U) << people.text();
    }
}

TEST(CrowdRuns, IdsOfCarsAndWalkersNeverMeet) {
    const std::vector<KeptTick> ticks = run(street_life(30, 1));
    for (const KeptTick& tick : ticks) {
        for (const world::CarState& car : tick.recorded().view.cars())
            EXPECT_LT(car.id(), walkers::first_walker_id);
        for (const world::WalkerState& walker : tick.recorded().view.walkers())
            EXPECT_GE(walker.id(), walkers::first_walker_id);
    }
}

/// From one side of a road with a crossing to the other, told to go by the map or straight.
std::vector<world::Vec3> way_of(const std::string& options) {
    const std::string body =
        "local w = spawn{ name = 'w', model = 'adult', x = 150, y = 88, heading_deg = 0 }\n"
        "w:walk_to{ x = 150, y = 104" +
        options + " }\nwait(600)";
    world::Recording recording = in_town1(body, 0, 150);
    std::vector<world::Vec3> way;
    for (const KeptTick& tick : run(recording))
        if (!tick.recorded().view.walkers().empty())
            way.push_back(tick.recorded().view.walkers()[0].position());
    return way;
}

TEST(CrowdRuns, AScriptedWalkerGoesByTheMapWhereItIsTold) {
    const auto straight = way_of("");
    const auto by_map = way_of(", by = 'map'");
    for (const auto& way : {straight, by_map}) {
        ASSERT_FALSE(way.empty());
        EXPECT_NEAR(way.back().x(), 150, 0.1);
        EXPECT_NEAR(way.back().y(), 104, 0.1);
    }
    const auto farthest = [](const std::vector<world::Vec3>& way) {
        double far = 0;
        for (const world::Vec3& p : way)
            far = std::max(far, std::abs(p.x() - 150));
        return far;
    };
    EXPECT_LT(farthest(straight), 0.1);
    EXPECT_GT(farthest(by_map), 10) << "to a crossing and back";
}

}  // namespace

}  // namespace reprise::test
