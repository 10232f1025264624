#include "scripting/scenario.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

namespace reprise::scripting {

namespace {

const std::string& busy() {
    static const std::string source = test::running(R"(
        local ego = spawn{ model = 'sedan', lane = 'east_1', s = 20, speed = 10 }
        local other = spawn{ model = 'hatchback', driver = 'traffic', lane = 'east_2', s = 5, speed = 14 }
        check.max('gap', function() return gap(ego, other) end, 100)
        check.never('collision', function() return ego:collided() end)
        start(function() while true do wait(random('pause')) print(time(), random()) end end)
        wait_until(function() return gap(ego, other) > 8 and other:x() > ego:x() end, { timeout = 30 })
        other:change_lane('right', { over = 2.5 })
        wait(1)
        finish 'done')");
    return source;
}

}  // namespace

TEST(Scenario, EqualTicksGiveEqualCommandsAndDigests) {
    test::Stage one(busy());
    test::Stage two(busy());
    one.play(400);
    two.play(400);
    ASSERT_EQ(one.reason(), "done");
    EXPECT_EQ(one.commands, two.commands);
    EXPECT_EQ(one.events, two.events);
    EXPECT_EQ(one.digests, two.digests);
    EXPECT_GT(one.digests.size(), 100U);
}

TEST(Scenario, DigestShowsEveryKindOfHiddenState) {
    const auto digest_after = [](const std::string& body) {
        test::Stage stage(test::running(body));
        stage.play(3);
        return stage.scenario.digest();
    };
    const std::vector<std::string> bodies{
        "wait(1)",
        "wait(2)",
        "start(function() wait(1) end) wait(1)",
        "random() wait(1)",
        "random('a') wait(1)",
        "spawn{ model = 'sedan' } wait(1)",
        "check.never('a', function() end) wait(1)",
        "check.never('a', function() end, { stop = true }) wait(1)",
        "check.always('a', function() return 1 end) wait(1)",
        "check.max('a', function() return 0 end, 1) wait(1)",
        "check.max('a', function() return 0 end, 2) wait(1)",
        "check.max('a', function() return nil end, 1) wait(1)",
        "check.eventually('a', function() return true end) wait(1)",
        "check.eventually('a', function() end) wait(1)",
        "check.eventually('a', function() end, { within = 9 }) wait(1)",
        "local kept = { 1 } wait(1)",
        "local kept = { 1, 2, 3, 4, 5 } wait(1)",
        "for i = 1, 5000 do end wait(1)"};
    std::vector<std::uint64_t> digests;
    for (const std::string& body : bodies) {
        EXPECT_EQ(digest_after(body), digest_after(body)) << body;
        digests.push_back(digest_after(body));
    }
    std::sort(digests.begin(), digests.end());
    EXPECT_EQ(std::unique(digests.begin(), digests.end()), digests.end());
}

TEST(Scenario, RunReceivesTheEpisodesParametersNotTheFilesOwn) {
    const char* source =
        "return scenario 'x' { params = { gap = 12, name = 'a' }, "
        "run = function(p) print(p.gap, p.name) end }";
    world::EpisodeT episode = test::episode(source);
    const world::TownT town = test::straight_road();
    for (const auto& [key, value] :
         std::vector<std::pair<std::string, std::string>>{{"gap", "20.5"}, {"name", "'it\\'s'"}}) {
        world::ParameterT parameter;
        parameter.key = key;
        parameter.value = value;
        episode.parameters.push_back(parameter);
    }
    const world::LaneMap lanes(town);
    Scenario scenario(episode, town, lanes);
    world::TickDraft next;
    scenario.advance(test::tick_with({}, {}, {}, 0).view(), next);
    ASSERT_EQ(next.tick.events.size(), 1U);
    EXPECT_EQ(next.tick.events[0].text, "20.5 it's");
    EXPECT_EQ(next.tick.commands.at(0).text, "scenario ended");
}

TEST(Scenario, DoesNothingMoreAfterItFinished) {
    test::Stage stage(
        test::running("start(function() while true do print 'x' wait_ticks(1) end end) finish()"));
    stage.play(1);
    const std::uint64_t digest = stage.scenario.digest();
    const world::TickDraft& draft = stage.step();
    EXPECT_TRUE(draft.tick.commands.empty());
    EXPECT_TRUE(draft.tick.events.empty());
    EXPECT_EQ(stage.scenario.digest(), digest);
}

}  // namespace reprise::scripting
