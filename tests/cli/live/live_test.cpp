#include "tests/cli/live/live.h"

#include <algorithm>
#include <cstdio>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/process/picture_memory.h"
#include "render/event_file.h"
#include "render/picture.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"
#include "world/external/rig.h"

namespace reprise::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* rig = R"(rig = {
    { name = 'rgb', width = 84, height = 84 },
    { name = 'depth', kind = 'depth', width = 84, height = 84 },
    { name = 'semantic', kind = 'semantic', width = 84, height = 84 },
    { name = 'instance', kind = 'instance', width = 60, height = 40, every = 3 },
    { name = 'flow', kind = 'flow', width = 60, height = 40, every = 3, attributes = { own_car = 1 } },
    { name = 'side', width = 60, height = 40, fov_deg = 70, yaw_deg = 80, pitch_deg = -5, y = 0.8, every = 3,
      attributes = { readout_time = 20, motion_blur = 1, samples = 2, k1 = -0.2, noise = 1 } },
    { name = 'events', kind = 'dvs', width = 60, height = 40, every = 3, attributes = { samples = 1 } },
}, )";

constexpr const char* python =
    "PYTHONPATH=" REPRISE_SOURCE "/python /usr/bin/python3 -B " REPRISE_SOURCE
    "/tests/cli/live/looking_driver.py ";

/// Of a process that may be gone already: below 0.
int pidfd(pid_t process) {
    return static_cast<int>(syscall(SYS_pidfd_open, process, 0));
}

class LiveFrames : public Live {
  protected:
    /// Each frame that a driver kept is what the renderer makes of the trace, and what `reprise
    /// render` writes, to the last bit; and none is missing but of the last ticks of a late driver,
    /// which the run does not wait for.
    void expect_frames_of_trace(const std::string& name,
                                const std::string& frames,
                                std::uint64_t latency = 0) {
        const Result rendered =
            reprise({"render", name + ".mcap", "-o", name + "_again"}, folder_.path());
        ASSERT_EQ(rendered.code, 0) << rendered.out;
        replay::TraceReader trace(folder_ / (name + ".mcap"));
        render::Sensors sensors(trace.recording().town);
        world::Rig carried;
        std::size_t pictures = 0;
        std::size_t shown = 0;
        std::vector<std::uint8_t> last_tick;
        std::vector<std::uint8_t> last_traffic;
        for (std::uint64_t index = 1; index < trace.last(); ++index) {
            render::Neighbours neighbours;
            if (!last_tick.empty())
                neighbours.last = render::Neighbour{
                    {world::GetTick(last_tick.data()), world::GetTraffic(last_traffic.data())}, {}};
            const replay::RecordedTick recorded = trace.tick(index);
            const world::TickView tick = recorded.view;
            for (const world::Command* command : *tick.tick->commands())
                carried = world::rig_of(*command, index);
            for (const std::size_t due : carried.due(index)) {
                const auto again = sensors.observe(
                    tick, {carried.sensors[due]}, *tick.tick->weather(), neighbours);
                const world::SensorFrame& frame = again.front();
                const std::string pixels(frame.data.begin(), frame.data.end());
                const std::string seen = kept_frame(frames, frame);
                if (index + latency < trace.last() || !seen.empty()) {
                    EXPECT_TRUE(seen == pixels) << frame.name << " at " << index;
                    ++shown;
                }
                const bool events = frame.kind == world::SensorKind::dvs;
                const std::string ending = events ? "npy" : "png";
                const std::string written = folder_ / ("one." + ending);
                if (events)
                    render::write_events(frame, written);
                else
                    render::write_png(frame, written);
                EXPECT_TRUE(
                    read_file(written) ==
                    read_file(folder_ /
                              fmt::format("{}_again/{}/{:06}.{}", name, frame.name, index, ending)))
                    << frame.name << " at " << index;
                ++pictures;
            }
            last_tick.assign(recorded.tick_bytes.begin(), recorded.tick_bytes.end());
            last_traffic.assign(recorded.traffic_bytes.begin(), recorded.traffic_bytes.end());
        }
        EXPECT_EQ(kept(frames).size(), shown);
        const std::size_t unseen = carried.due(trace.last()).size();  // nobody is asked behind it
        EXPECT_THAT(rendered.out, HasSubstr(fmt::format(": {} pictures of ", pictures + unseen)));
    }
};

TEST_F(LiveFrames, FramesThatCameThroughAPortAreThoseOfTheTrace) {
    scenario("port", std::string("driver = 'external', ") + rig);
    make_folder("frames");
    const Result result = typed(
        "reprise run port.lua --driver ego=tcp:0 -o port.mcap 2>said & run=$!; until "
        "port=$(sed -n 's/.*may come to 127.0.0.1://p' said 2>/dev/null | grep .); do kill "
        "-0 $run || exit 9; done; REPRISE_DRIVER=127.0.0.1:$port " REPRISE_LOOKING_DRIVER
        " frames; wait $run",
        folder_);
    EXPECT_EQ(result.code, 0) << result.out;
    expect_frames_of_trace("port", "frames");
}

TEST_F(LiveFrames, ASliceBehindTheSpawnGivesTheFramesOfTheWholeTrace) {
    scenario("seen", std::string(rig) + "driver = 'external' ");
    run("seen", compiled + make_folder("cpp"));
    reprise({"slice", "seen.mcap", "--ticks", "3..9", "-o", "middle.mcap"}, folder_.path());
    reprise({"slice", "middle.mcap", "--ticks", "5..8", "-o", "tail.mcap"}, folder_.path());
    for (const std::string name : {"seen", "tail"}) {
        const Result rendered =
            reprise({"render", name + ".mcap", "--from", "5", "--to", "8", "-o", name + "_frames"},
                    folder_.path());
        EXPECT_EQ(rendered.code, 0) << rendered.out;
    }
    std::size_t frames = 0;
    for (const auto& one : std::filesystem::recursive_directory_iterator(folder_ / "seen_frames")) {
        if (!one.is_regular_file() || one.path().filename() == "manifest.json")
            continue;
        ++frames;
        const std::filesystem::path same =
            folder_ / "tail_frames" /
            std::filesystem::relative(one.path(), folder_ / "seen_frames");
        EXPECT_EQ(read_file(same), read_file(one.path())) << same;
    }
    EXPECT_GE(frames, 8U) << "of several sensors, some not in every tick";
}

TEST_F(LiveFrames, OfOddSizesAreThoseThatTheTraceGivesAfterwards) {
    // Few pixels, or many in one direction only: rows of no whole words, no whole blocks of rays.
    scenario("odd", std::string("driver = 'external', latency = 2, ") + R"(rig = {
        { name = 'dot', width = 1, height = 1 },
        { name = 'dot_depth', kind = 'depth', width = 1, height = 1, fov_deg = 1 },
        { name = 'dot_label', kind = 'instance', width = 1, height = 1, fov_deg = 170, every = 7 },
        { name = 'row', width = 4096, height = 1, every = 4 },
        { name = 'column', kind = 'semantic', width = 3, height = 4096, every = 4 },
        { name = 'odd', kind = 'flow', width = 17, height = 31, every = 3 },
        { name = 'odd_normals', kind = 'normals', width = 31, height = 17, fov_deg = 169, every = 3 },
        { name = 'rough', width = 7, height = 5, attributes = { readout_time = 7, samples = 3, motion_blur = 1 } },
        { name = 'dot_events', kind = 'dvs', width = 1, height = 1 },
    }, )");
    run("odd", compiled + make_folder("odd_frames"));
    expect_frames_of_trace("odd", "odd_frames", 2);
}

TEST_F(LiveFrames, FramesSeenAreThoseThatTheTraceGivesAfterwards) {
    scenario("seen", std::string(rig) + "driver = 'external' ");
    run("seen", compiled + make_folder("cpp"));
    expect_frames_of_trace("seen", "cpp");
    const std::vector<std::string> names = kept("cpp");
    EXPECT_EQ(std::count_if(names.begin(),
                            names.end(),
                            [](const std::string& name) { return name.starts_with("side"); }),
              3)
        << "every third tick";
}

TEST_F(LiveFrames, PythonSeesTheSameAsCpp) {
    scenario("seen", std::string(rig) + "driver = 'external' ");
    run("seen", compiled + make_folder("cpp"));
    const std::string trace = read_file(folder_ / "seen.mcap");
    run("seen", python + make_folder("py"));
    EXPECT_TRUE(trace == read_file(folder_ / "seen.mcap"));
    ASSERT_EQ(kept("cpp"), kept("py"));
    ASSERT_THAT(kept("cpp"), Not(IsEmpty()));
    for (const std::string& name : kept("cpp"))
        EXPECT_TRUE(read_file(folder_ / ("cpp/" + name + ".raw")) ==
                    read_file(folder_ / ("py/" + name + ".raw")))
            << name;
}

TEST_F(LiveFrames, ALateDriverSeesTheFramesOfItsTicks) {
    scenario("late", std::string(rig) + "driver = 'external', latency = 3 ");
    run("late", compiled + make_folder("frames"));
    expect_frames_of_trace("late", "frames", 3);
}

TEST_F(LiveFrames, WhoSeesSensorsOnlyIsShownNothingOfOthers) {
    scenario("blind", std::string(rig) + "driver = 'external', sees = 'sensors' ");
    run("blind", python + make_folder("frames") + " sensors");
    expect_frames_of_trace("blind", "frames");
}

struct Pair {
    std::string said;    ///< of both
    std::string sees;    ///< of the one with the rig, or another rig
    std::string driver;  ///< of both
};

/// All of a tick but what is made of the script itself, where the rig stands.
world::TickT without_script(const world::TickView& view) {
    world::TickT tick;
    view.tick->UnPackTo(&tick);
    tick.digests.mutate_scenario(0);
    tick.digests.mutable_state() = {};
    tick.digests.mutable_chain() = {};
    for (world::CommandT& command : tick.commands) {
        command.rig.clear();
        command.sees_sensors = false;
    }
    return tick;
}

world::TrafficT traffic(const world::TickView& view) {
    world::TrafficT traffic;
    view.traffic->UnPackTo(&traffic);
    return traffic;
}

TEST_F(LiveFrames, SensorsNeverChangeWhatHappens) {
    const std::string driver = compiled + make_folder("frames");
    for (const Pair& pair :
         {Pair{"driver = 'external' ", "", driver},
          Pair{"driver = 'external', latency = 1 ", measuring_rig, driver},
          Pair{"driver = 'external', latency = 2 ", "sees = 'sensors', ", driver},
          Pair{"driver = 'autopilot' ", "", ""}}) {
        const bool own_rig = pair.sees.starts_with("rig");
        scenario("with", (own_rig ? "" : rig) + pair.sees + pair.said);
        scenario("without", pair.said);
        run("with", pair.driver);
        run("without", pair.driver);
        replay::TraceReader with(folder_ / "with.mcap");
        replay::TraceReader without(folder_ / "without.mcap");
        ASSERT_EQ(with.ticks(), 10U);
        ASSERT_EQ(without.ticks(), 10U);
        for (std::uint64_t index = 1; index <= 10; ++index) {
            const world::TickView one = with.tick(index).view;
            const world::TickView other = without.tick(index).view;
            EXPECT_TRUE(without_script(one) == without_script(other)) << pair.said << index;
            EXPECT_TRUE(traffic(one) == traffic(other)) << pair.said << index;
        }
        const Result verified = reprise({"verify", "with.mcap"}, folder_.path());
        EXPECT_EQ(verified.code, 0) << verified.out;
    }
}

TEST_F(LiveFrames, ARendererThatDiesIsOurFaultAndTheTraceIsWhole) {
    scenario("killed", std::string(rig) + "driver = 'external' ");
    const std::string told = run("killed", compiled + make_folder("frames") + " kill", 70);
    EXPECT_THAT(told,
                HasSubstr("reprise: this is our fault, please report it: the process that renders "
                          "for 'ego' was ended by signal 9\n"));
    EXPECT_THAT(told, HasSubstr("driver_lost"));
    const Result verified = reprise({"verify", "killed.mcap"}, folder_.path());
    EXPECT_EQ(verified.code, 0) << verified.out;
    EXPECT_EQ(replay::TraceReader(folder_ / "killed.mcap").ticks(), 7U);
}

TEST_F(LiveFrames, ARendererEndsWithItsRunHoweverThatEnds) {
    scenario("ended", std::string(rig) + "driver = 'external' ");
    reprise(
        {"run", "ended.lua", "--driver", "ego=" + (compiled + make_folder("frames")) + " kill_run"},
        folder_.path());
    const std::string id = read_file(folder_ / "frames/renderer");
    ASSERT_NE(id, "");
    const int descriptor = pidfd(std::stoi(id));
    if (descriptor < 0)
        return;  // it is gone already
    pollfd gone{descriptor, POLLIN, 0};
    EXPECT_EQ(poll(&gone, 1, 60'000), 1) << "it still runs a minute later";
    close(descriptor);
}

TEST_F(LiveFrames, ARendererHasItsMemoryInHugePagesUnlessTheUserHasSaidSomething) {
    scenario("memory", std::string(rig) + "driver = 'external' ");
    const std::string driver = compiled + make_folder("frames") + " memory";
    const auto told = [&] {
        run("memory", driver, 0);
        return read_file(folder_ / "frames/memory");
    };
    unsetenv("GLIBC_TUNABLES");
    EXPECT_EQ(told(), cli::picture_memory);
    setenv("GLIBC_TUNABLES", "glibc.malloc.top_pad=131072", 1);
    EXPECT_EQ(told(), "glibc.malloc.top_pad=131072");
    unsetenv("GLIBC_TUNABLES");
}

TEST_F(LiveFrames, ADriverThatNeverComesIsAllThatIsTold) {
    scenario("alone", std::string(rig) + "driver = 'external' ");
    EXPECT_THAT(run("alone", compiled + make_folder("frames") + " leave", 1),
                testing::StartsWith("reprise: the driver of 'ego' ended with exit code 5\n"));
}

TEST_F(LiveFrames, EachOfSeveralSeesItsOwn) {
    const std::string other =
        "driver = 'external' } spawn{ name = 'other', model = 'van', driver = "
        "'external', rig = { { name = 'rgb', width = 40, height = 30 } } ";
    scenario("two", rig + other);
    const Result ran = reprise({"run",
                                "two.lua",
                                "-o",
                                "two.mcap",
                                "--driver",
                                "ego=" + (compiled + make_folder("ego")),
                                "--driver",
                                "other=" + (compiled + make_folder("other"))},
                               folder_.path());
    ASSERT_EQ(ran.code, 0) << ran.out;
    EXPECT_EQ(kept("ego").size(), 7U * 3 + 4 * 3);
    EXPECT_EQ(kept("other").size(), 7U);
    replay::TraceReader trace(folder_ / "two.mcap");
    render::Sensors sensors(trace.recording().town);
    for (const std::string who : {"ego", "other"}) {
        const world::TickView spawning = trace.tick(3).view;
        world::SensorSpec sensor;
        for (const world::Command* command : *spawning.tick->commands())
            if (command->text()->str() == who)
                sensor = world::rig_of(*command, 3).sensors.front();
        const world::TickView tick = trace.tick(9).view;
        const auto again = sensors.observe(tick, {sensor}, *tick.tick->weather());
        const std::string pixels(again.front().data.begin(), again.front().data.end());
        EXPECT_TRUE(kept_frame(who, again.front()) == pixels) << who;
    }
}

TEST_F(LiveFrames, OtherCamerasAreRenderedWhereTheyAreAskedFor) {
    scenario("other", std::string(rig) + "driver = 'autopilot' ");
    run("other", "");
    const auto files = [&](const std::vector<std::string>& more) {
        const Folder out;
        std::vector<std::string> words{"render", folder_ / "other.mcap", "-o", out / "p"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = reprise(words);
        EXPECT_EQ(result.code, 0) << result.out;
        std::vector<std::string> found = out.files();
        EXPECT_EQ(std::erase(found, "p/manifest.json"), 1U);
        return found;
    };
    EXPECT_THAT(files({"--size", "40x30", "--every", "8", "--from", "2"}),
                ElementsAre("p/000010.png"))
        << "in tick 2 there is nobody yet";
    EXPECT_THAT(files({"--camera", "depth", "--size", "40x30", "--from", "10"}),
                ElementsAre("p/000010.png", "p/view/000010.png"));
    EXPECT_THAT(files({"--from", "10"}),
                ElementsAre("p/depth/000010.png",
                            "p/depth/view/000010.png",
                            "p/rgb/000010.png",
                            "p/semantic/000010.png",
                            "p/semantic/view/000010.png"));
    EXPECT_THAT(files({"--from", "9", "--to", "9"}), testing::Contains("p/side/000009.png"));
    EXPECT_THAT(files({"--from", "10", "--every", "1"}), testing::Contains("p/side/000010.png"));
}

}  // namespace
}  // namespace reprise::test
