#include "kernel/verify.h"

#include <filesystem>
#include <unistd.h>

#include <gmock/gmock.h>

#include "replay/trace_writer.h"
#include "tests/kernel/whole_run.h"
#include "world/digest.h"

namespace reprise::test {

namespace {

using testing::HasSubstr;

/// A trace, removed afterwards.
class Verify : public testing::Test {
  protected:
    Verify()
        : path_(std::filesystem::temp_directory_path() /
                ("reprise_verify_" + std::to_string(getpid()) + ".mcap")) {}

    ~Verify() override { std::filesystem::remove(path_); }

    void record(const world::Recording& recording, const std::string& nudge = "") {
        replay::TraceWriter trace(path_, recording);
        kernel::Kernel kernel(recording);
        if (!nudge.empty())
            kernel.nudge(kernel::parse_nudge(nudge));
        while (!kernel.finished())
            trace.append(kernel.step());
        trace.close(kernel.outcome());
    }

    std::optional<replay::Divergence> verified() {
        replay::TraceReader trace(path_);
        return kernel::verify(trace);
    }

    std::filesystem::path path_;
};

const std::string drive = R"(
    local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' }
    wait(0.5)
    ego:set_speed_kmh(20)
    wait(60))";

TEST_F(Verify, FindsNothingInAnHonestTrace) {
    record(in_town1(drive, 10, 1));
    EXPECT_EQ(verified(), std::nullopt);
}

TEST_F(Verify, SaysWhoWhatWhenAndWhatTheScenarioSaidLast) {
    record(in_town1(drive, 10, 1), "17:ego.velocity.x");
    const auto found = verified();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->tick, 17u);
    EXPECT_EQ(found->stage, "physics");
    EXPECT_EQ(found->actor, "ego (1)");
    EXPECT_EQ(found->field, "vehicles[id 1].velocity.x");
    EXPECT_EQ(found->note, "1 unit in the last place apart");
    EXPECT_EQ(found->script, "tick 11 (0.55 s): set_speed of ego (1), test.lua:6");
    EXPECT_THAT(to_text(*found, 50'000'000), HasSubstr("set_speed of ego (1), test.lua:6"));
}

TEST_F(Verify, RefusesATraceWithAnotherNetworkInIt) {
    world::Recording other = in_town1(drive, 0, 1);
    other.network.replace(other.network.find("13.89"), 5, "13.88");
    replay::TraceWriter(path_, other).close({"completed", "", 0});
    const auto found = verified();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->stage, "start");
    EXPECT_EQ(found->field, "town_digest");
    EXPECT_EQ(found->expected, world::to_hex(other.episode.town_digest));
}

}  // namespace

}  // namespace reprise::test
