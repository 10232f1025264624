#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"

// Lights that the scenario takes from their programs, and gives back.
namespace reprise::traffic {
namespace {

using test::command;
using test::own_town;
using test::Stage;
using world::CommandKind;
using world::SignalColor;

using Colors = std::vector<SignalColor>;

world::CommandT set_signal(std::vector<std::uint32_t> signals,
                           SignalColor color,
                           double duration = 0) {
    world::CommandT order = command(CommandKind::set_signal, 0);
    order.signals = std::move(signals);
    order.color = color;
    order.duration = duration;
    return order;
}

/// What the lights of a town do by themselves, tick by tick: [tick - 1][signal].
std::vector<Colors> undisturbed(const test::Loaded& loaded, int ticks) {
    Stage stage(loaded, 0);
    std::vector<Colors> all;
    for (int i = 0; i < ticks; ++i)
        all.push_back(stage.step().tick.signals);
    return all;
}

/// A signal for cars, at a light with several.
std::uint32_t some_signal(const world::TownT& town) {
    for (std::uint32_t i = 0; i + 1 < town.signals.size(); ++i)
        if (!town.signals[i].for_walkers && town.signals[i].program == town.signals[i + 1].program)
            return i;
    return world::none;
}

TEST(SignalOrders, AreShownForTheirTimeAndThenTheProgramGoesOnAsIfNothingHadBeen) {
    const test::Loaded& loaded = own_town("town1");
    constexpr int ticks = 3000;  // more than one round of every program
    const std::vector<Colors> alone = undisturbed(loaded, ticks);
    const std::uint32_t signal = some_signal(loaded.town);
    ASSERT_NE(signal, world::none);
    Stage stage(loaded, 0);
    constexpr int first = 101;
    constexpr int held = 1500;
    for (int tick = 1; tick <= ticks; ++tick) {
        std::vector<world::CommandT> said;
        if (tick == first)
            said = {set_signal({signal}, SignalColor::yellow, held * 0.05)};
        const Colors& colors = stage.step(said).tick.signals;
        const Colors& expected = alone[static_cast<std::size_t>(tick - 1)];
        const Colors& late = alone[static_cast<std::size_t>(std::max(tick - 2, 0))];
        for (std::size_t i = 0; i < colors.size(); ++i) {
            const bool ordered = i == signal && tick >= first && tick < first + held;
            if (ordered) {
                ASSERT_EQ(colors[i], SignalColor::yellow) << "tick " << tick;
            } else {
                ASSERT_TRUE(colors[i] == expected[i] || colors[i] == late[i])
                    << "signal " << i << " in tick " << tick;
            }
        }
        if (tick >= first + held + 1) {
            ASSERT_EQ(colors, expected) << "tick " << tick;
        }
    }
}

TEST(SignalOrders, AreTakenBackByTheProgramsName) {
    const test::Loaded& loaded = own_town("town1");
    const std::vector<Colors> alone = undisturbed(loaded, 60);
    const std::uint32_t signal = some_signal(loaded.town);
    Stage stage(loaded, 0);
    stage.step({set_signal({signal}, SignalColor::red_yellow)});
    EXPECT_EQ(stage.draft().tick.signals[signal], SignalColor::red_yellow) << "in the same tick";
    stage.steps(20);
    EXPECT_EQ(stage.draft().tick.signals[signal], SignalColor::red_yellow) << "for good";
    stage.step({set_signal({signal}, SignalColor::off)});
    EXPECT_EQ(stage.draft().tick.signals, alone[stage.tick() - 1]);
}

TEST(SignalOrders, HoldCarsAtRedAndLetThemGoAtGreen) {
    const test::Loaded& loaded = own_town("town1");
    const world::TownT& town = loaded.town;
    const auto lane = std::find_if(town.lanes.begin(), town.lanes.end(), [&](const auto& each) {
        return each.kind == world::LaneKind::driving && each.length > 60 && !each.links.empty() &&
               each.links.front().signal() != world::none;
    });
    ASSERT_NE(lane, town.lanes.end());
    std::vector<std::uint32_t> signals;
    for (const world::Link& link : lane->links)
        signals.push_back(link.signal());
    Stage stage(loaded, 0);
    stage.step(
        {set_signal(signals, SignalColor::red),
         test::spawn(
             3, static_cast<std::uint32_t>(lane - town.lanes.begin()), lane->length - 45, 8)});
    stage.steps(1200);  // a minute: any program would have shown green by then
    ASSERT_NE(stage.car(3), nullptr);
    EXPECT_EQ(stage.car(3)->speed(), 0);
    EXPECT_EQ(stage.car(3)->lane(), lane - town.lanes.begin()) << "it waits at the line";
    stage.step({set_signal(signals, SignalColor::green)});
    stage.steps(200);
    EXPECT_TRUE(stage.car(3) == nullptr || stage.car(3)->lane() != lane - town.lanes.begin())
        << "it went";
}

}  // namespace
}  // namespace reprise::traffic
