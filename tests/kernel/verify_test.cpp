#include "kernel/verify.h"

#include <algorithm>
#include <filesystem>
#include <unistd.h>

#include <gmock/gmock.h>

#include "replay/level.h"
#include "replay/trace_writer.h"
#include "tests/kernel/whole_run.h"
#include "tests/replay/forgery.h"
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

const std::string attached = "scenario/main.lua";

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

/// Every tick agrees and every checksum holds: only the bytes between them tell.
TEST_F(Verify, TellsAChangeWhereNoTickLies) {
    record(in_town1(drive, 0, 0.2));
    std::vector<std::uint8_t> bytes = read_file(path_);
    const std::string script = "wait(60)";
    const auto name = std::search(bytes.begin(), bytes.end(), attached.begin(), attached.end());
    const auto at = std::search(name, bytes.end(), script.begin(), script.end());
    ASSERT_NE(at, bytes.end());
    at[5] = '7';
    repair_checksums(bytes);
    write_file(path_, bytes);
    const auto found = verified();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->tick, 0u);
    EXPECT_EQ(found->field, "the file's bytes");
    EXPECT_THAT(found->note, HasSubstr("in the attachment 'scenario/main.lua'"));
}

TEST_F(Verify, TellsAnotherOutcome) {
    const world::Recording start = in_town1(drive, 0, 0.2);
    {
        replay::TraceWriter trace(path_, start);
        kernel::Kernel kernel(start);
        while (!kernel.finished())
            trace.append(kernel.step());
        trace.close({"passed", "time limit", 0});
    }
    const auto found = verified();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->stage, "end");
    EXPECT_EQ(found->expected, "passed: time limit");
    EXPECT_EQ(found->found, "completed: time limit");
}

TEST_F(Verify, TellsTicksThatAreMissingAtTheEnd) {
    const world::Recording start = in_town1(drive, 0, 0.5);
    {
        replay::TraceWriter trace(path_, start);
        const std::vector<KeptTick> ticks = run(start);
        for (std::size_t i = 0; i < 7; ++i)
            trace.append(ticks[i].recorded());
        trace.close({"completed", "time limit", 0});
    }
    const auto found = verified();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->tick, 7u);
    EXPECT_EQ(found->found, "the run goes on");
}

/// What nobody drove by hand is not among the inputs: a copy of what the driver said would be
/// ignored by the simulation, and is told.
TEST_F(Verify, TellsAControlThatIsNoInput) {
    const world::Recording start = in_town1(drive, 0, 0.2);
    {
        replay::TraceWriter trace(path_, start, replay::Level::inputs);
        for (const KeptTick& tick : run(start)) {
            replay::RecordedTick kept = tick.recorded();
            const auto controls = kept.view.controls();
            ASSERT_EQ(controls.size(), 1u);
            const auto inputs =
                replay::inputs_of(*kept.view.tick, {controls.begin(), controls.end()});
            kept.tick_bytes = {inputs.data(), inputs.size()};
            kept.view.tick = world::GetTick(inputs.data());
            trace.append(kept);
        }
        trace.close({"completed", "time limit", 0});
    }
    const auto found = verified();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->stage, "controls");
}

}  // namespace

}  // namespace reprise::test
