#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include <gmock/gmock.h>

#include "kernel/kernel.h"
#include "process/copy.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/random.h"

namespace reprise::test {
namespace {

using Chain = std::vector<std::string>;  ///< [i] after tick i + 1, hexadecimal

std::unique_ptr<world::Recording> load(const std::string& scenario,
                                       const std::string& town,
                                       double seconds) {
    auto recording = std::make_unique<world::Recording>();
    const std::string folder = REPRISE_SOURCE;
    recording->episode = scripting::load_episode(folder + scenario, {town, 7, seconds, {}});
    towns::Network network =
        towns::load_network(folder + "/scenarios/towns/" + town + "/" + town + ".net.xml");
    recording->town = towns::read_town(network);
    recording->network = std::move(network.xml);
    return recording;
}

/// The run that is repeated: everything happens in it, see there.
std::unique_ptr<world::Recording> crash() {
    return load("/tests/determinism/collision.lua", "town1", 6);
}

std::unique_ptr<world::Recording> drive() {
    return load("/scenarios/free_drive.lua", "town2", 5);
}

void step(kernel::Kernel& kernel, Chain& chain) {
    chain.push_back(world::to_hex(kernel.step().view().tick->digests()->chain()));
}

void finish(kernel::Kernel& kernel, Chain& chain) {
    while (!kernel.finished())
        step(kernel, chain);
}

Chain run(const world::Recording& recording) {
    kernel::Kernel kernel(recording);
    Chain chain;
    finish(kernel, chain);
    return chain;
}

/// Does `work` in a child that is a copy of this process, and returns what it returned there.
Chain in_child(const std::function<Chain()>& work) {
    const std::string text = process::run_copy({.subject = "copy", .work = [&] {
                                                    std::string all;
                                                    for (const std::string& each : work())
                                                        all += each;
                                                    return all;
                                                }});
    Chain chain;
    constexpr std::size_t digits = 32;
    for (std::size_t i = 0; i + digits <= text.size(); i += digits)
        chain.push_back(text.substr(i, digits));
    return chain;
}

/// The first tick in which two runs differ; 0: none.
std::size_t first_difference(const Chain& expected, const Chain& found) {
    const auto [one, other] =
        std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
    const bool equal = one == expected.end() && other == found.end();
    return equal ? 0 : static_cast<std::size_t>(one - expected.begin()) + 1;
}

/// Leaves the heap in holes that are full of something: what reads memory that it has not written
/// reads other values than in a fresh process.
void soil_the_heap() {
    std::vector<std::unique_ptr<std::vector<unsigned char>>> blocks;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        const auto size = world::draw_index(4000, 1, i, world::Purpose::place, 0) + 16;
        blocks.push_back(std::make_unique<std::vector<unsigned char>>(size, (i * 37) & 0xff));
    }
    for (std::size_t i = 0; i < blocks.size(); i += 2)
        blocks[i].reset();
}

class WarmProcess : public ::testing::Test {
  protected:
    WarmProcess() : crash_(crash()), alone_(in_child([this] { return run(*crash_); })) {}

    std::unique_ptr<world::Recording> crash_;
    Chain alone_;  ///< of the crash, in a process in which nothing ran before
};

TEST_F(WarmProcess, RunsTheSameAfterAnotherScenarioAndWithADirtyHeap) {
    ASSERT_EQ(alone_.size(), 120U);
    EXPECT_EQ(first_difference(alone_, run(*crash_)), 0U) << "first run";
    const auto other = drive();
    const Chain another = run(*other);
    EXPECT_NE(first_difference(alone_, another), 0U);
    soil_the_heap();
    EXPECT_EQ(first_difference(alone_, run(*crash_)), 0U) << "after another town";
    EXPECT_EQ(first_difference(another, run(*other)), 0U) << "the other one again";
}

TEST_F(WarmProcess, RunsTheSameAfterRunsThatWereCutOff) {
    for (const int ticks : {0, 1, 30, 60}) {
        const auto recording = ticks == 30 ? drive() : crash();
        kernel::Kernel kernel(*recording);
        Chain cut;
        for (int i = 0; i < ticks; ++i)
            step(kernel, cut);
    }
    EXPECT_EQ(first_difference(alone_, run(*crash_)), 0U);
}

TEST_F(WarmProcess, GoesOnEquallyInAForkAndInItsParent) {
    kernel::Kernel kernel(*crash_);
    Chain chain;
    for (const std::size_t tick : {1U, 27U, 28U, 60U, 119U}) {  // in tick 27 two vehicles touch
        while (chain.size() < tick)
            step(kernel, chain);
        kernel.rest();
        const Chain forked = in_child([&] {
            Chain copy = chain;
            soil_the_heap();
            finish(kernel, copy);
            return copy;
        });
        EXPECT_EQ(first_difference(alone_, forked), 0U) << "forked after tick " << tick;
    }
    finish(kernel, chain);
    EXPECT_EQ(first_difference(alone_, chain), 0U) << "the parent";
}

}  // namespace
}  // namespace reprise::test
