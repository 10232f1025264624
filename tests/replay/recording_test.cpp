#include "world/recording.h"

#include <set>

#include <gmock/gmock.h>

#include "replay/chain_seed.h"
#include "tests/replay/synthetic_run.h"
#include "world/digest.h"

namespace reprise::test {

namespace {

using world::Recording;

/// The chain's start after one change.
std::string seed_with(const std::function<void(world::Recording&)>& change) {
    world::Recording changed = recording();
    change(changed);
    return world::to_hex(replay::chain_seed(changed));
}

TEST(ChainSeed, DependsOnAllThatDecidesTheRun) {
    const std::vector<std::string> seeds{
        seed_with([](world::Recording&) {}),
        seed_with([](world::Recording& r) { r.episode.seed = 8; }),
        seed_with([](world::Recording& r) { r.episode.step_ns = 20'000'000; }),
        seed_with([](world::Recording& r) { r.episode.substeps = 3; }),
        seed_with([](world::Recording& r) { r.episode.max_ticks += 1; }),
        seed_with([](world::Recording& r) { r.episode.cars = 1; }),
        seed_with([](world::Recording& r) { r.episode.road_friction = 0.5; }),
        seed_with([](world::Recording& r) { r.episode.weather.mutate_rain(3); }),
        seed_with([](world::Recording& r) { r.episode.scenario += " "; }),
        seed_with([](world::Recording& r) {
            r.episode.parameters.emplace_back();
            r.episode.parameters.back().key = "gap";
        }),
        seed_with([](world::Recording& r) { r.episode.name += "x"; }),
        seed_with([](world::Recording& r) { r.episode.scenario_path = "elsewhere.lua"; }),
        seed_with([](world::Recording& r) { r.episode.weather_name += "x"; }),
        seed_with([](world::Recording& r) { r.episode.town += "x"; }),
        seed_with([](world::Recording& r) {
            r.episode.town_digest = {1, 1};
        }),
        seed_with([](world::Recording& r) { r.episode.imported_from = "carla"; }),
        seed_with([](world::Recording& r) { r.network += " "; }),
        seed_with([](world::Recording& r) { r.town.lanes[1].width = 3; }),
    };
    EXPECT_THAT(std::set<std::string>(seeds.begin(), seeds.end()), testing::SizeIs(seeds.size()));
}

TEST(ChainSeed, IgnoresTheBuildAndWhereTheTownLay) {
    const std::string same = seed_with([](world::Recording&) {});
    EXPECT_EQ(seed_with([](world::Recording& r) { r.episode.town_path = "/elsewhere/net.xml"; }),
              same);
    EXPECT_EQ(seed_with([](world::Recording& r) {
                  r.episode.fingerprint.emplace_back();
                  r.episode.fingerprint.back().key = "compiler";
              }),
              same);
}

/// A script that takes over and changes nothing yet is another history all the same.
TEST(ChainOfABranch, DependsOnAllThatTheBranchSays) {
    const auto chain_with = [](const std::function<void(world::BranchT&)>& change) {
        world::BranchT branch;
        change(branch);
        return world::to_hex(replay::chain_of_branch({1, 2}, branch));
    };
    const std::vector<std::string> chains{
        world::to_hex({1, 2}),
        chain_with([](world::BranchT&) {}),
        chain_with([](world::BranchT& b) { b.tick = 1; }),
        chain_with([](world::BranchT& b) { b.name = "x"; }),
        chain_with([](world::BranchT& b) { b.scenario_path = "x"; }),
        chain_with([](world::BranchT& b) { b.scenario = "x"; }),
        chain_with([](world::BranchT& b) { b.max_ticks = 1; }),
        chain_with([](world::BranchT& b) {
            b.parent_chain = {1, 0};
        }),
        chain_with([](world::BranchT& b) { b.parameters.emplace_back(); }),
    };
    EXPECT_THAT(std::set<std::string>(chains.begin(), chains.end()),
                testing::SizeIs(chains.size()));
}

}  // namespace

}  // namespace reprise::test
