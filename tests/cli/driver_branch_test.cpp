// What if another program drives on from here.
#include "tests/cli/drivers.h"

namespace reprise::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string steady = odd_driver + " steady";      // steers by 0.125
const std::string counting = odd_driver + " counting";  // steers by the tick / 1024

/// A run of 100 ticks that the steady driver drove.
class DriverBranch : public Drivers {
  protected:
    void SetUp() override {
        Drivers::SetUp();
        drive("one", steady, "parent.mcap");
        write_script("brake", "print('taken over') wait(60)");
        write_script("rain", "set_weather('hard_rain_sunset') wait(60)");
    }

    void write_script(const std::string& name, const std::string& body) const {
        write_file(folder_ / (name + ".lua"),
                   "return scenario '" + name + "' { run = function(p)\n" + body + "\nend }\n");
    }

    /// `reprise branch parent.mcap --at 50 ... -o OUT`
    std::string branch(const std::vector<std::string>& words,
                       const std::string& out,
                       int code = 0,
                       const std::string& parent = "parent.mcap") const {
        std::vector<std::string> all{"branch", parent, "--at", "50t"};
        all.insert(all.end(), words.begin(), words.end());
        all.insert(all.end(), {"-o", out});
        return run(all, code);
    }

    /// How the first vehicle was steered in a tick; with more than one, that with this index.
    double steer(const std::string& trace, std::uint64_t tick, std::uint32_t which = 0) const {
        return control(trace, tick, which).steer();
    }

    world::Control control(const std::string& trace,
                           std::uint64_t tick,
                           std::uint32_t which) const {
        replay::TraceReader reader(folder_ / trace);
        return reader.tick(tick).view.controls()[which];
    }
};

TEST_F(DriverBranch, AnotherOneTakesOverAtTheTick) {
    EXPECT_THAT(branch({"--driver", "ego=" + counting}, "b.mcap"), Not(HasSubstr("brakes")));
    EXPECT_EQ(steer("b.mcap", 50), 0.125);
    for (const std::uint64_t tick : {51U, 52U, 100U})
        EXPECT_EQ(steer("b.mcap", tick) * 1024, static_cast<double>(tick - 1)) << tick;
    EXPECT_THAT(run({"diff", "parent.mcap", "b.mcap"}, 1),
                HasSubstr("equal for 50 ticks; branched at tick 50 (2.50 s) by another driver; "
                          "first difference:\ntick 51"));
    EXPECT_THAT(run({"verify", "b.mcap"}, 0, {"PATH=/nonexistent"}),
                HasSubstr("equal at every one of 100 ticks"));
    run({"run", "b.mcap", "-o", "again.mcap"}, 0);
    EXPECT_TRUE(bytes("again.mcap") == bytes("b.mcap"));
    run({"strip", "b.mcap", "-o", "s.mcap", "--level", "inputs"}, 0);
    run({"expand", "s.mcap", "-o", "e.mcap"}, 0);
    EXPECT_TRUE(bytes("e.mcap") == bytes("b.mcap"));
    // And once more, from within the branch.
    run({"branch", "b.mcap", "--at", "70t", "--driver", "ego=" + steady, "-o", "bb.mcap"}, 0);
    EXPECT_EQ(steer("bb.mcap", 70) * 1024, 69);
    EXPECT_EQ(steer("bb.mcap", 71), 0.125);
    expect_equal("bb.mcap", 100);
}

TEST_F(DriverBranch, TheSameDriverMakesTheSameTicks) {
    branch({"--driver", "ego=" + steady}, "b.mcap");
    const auto vehicles = [&](const std::string& trace) {
        return run({"cat", trace, "--fields", "vehicles", "--format", "csv"}, 0);
    };
    EXPECT_EQ(vehicles("b.mcap"), vehicles("parent.mcap"));
}

TEST_F(DriverBranch, WhoTakesOverIsToldTheWayThatIsLeft) {
    write_file(folder_ / "guided.py",
               "import reprise\n"
               "file = open('seen.txt', 'w')\n"
               "def decide(seen):\n"
               "    if file.tell() == 0:\n"
               "        route, lanes = seen.run.route, seen.run.town.lanes\n"
               "        print([lanes[i].name for i in route.lanes] + [route.s] if route else None, "
               "file=file)\n"
               "    print(seen.index, seen.turning, seen.way_to_goal, file=file, flush=True)\n"
               "    return reprise.Control(throttle=0.2)\n"
               "reprise.drive(decide)\n");
    const std::string driver = PYTHON " -B guided.py";
    for (const std::string sees : {"everything", "sensors"}) {
        SCOPED_TRACE(sees);
        write_scenario("way",
                       spawn("ego", 75, ", speed_kmh = 40, sees = '" + sees + "'") +
                           "ego:set_route{ 'am_1', 'mb_1' }\n");
        drive("way", driver, "way.mcap");
        const std::string whole = bytes("seen.txt");
        const auto there = whole.find("\n50 ");
        ASSERT_NE(there, std::string::npos) << whole;
        EXPECT_THAT(whole, testing::StartsWith("None\n"));
        branch({"--driver", "ego=" + driver}, "b.mcap", 0, "way.mcap");
        // At the first stop, where it began, it has been.
        EXPECT_EQ(bytes("seen.txt"),
                  (sees == "everything" ? "['mb_1', 52.8]" : "None") + whole.substr(there));
        EXPECT_THAT(whole.substr(there), testing::StartsWith("\n50 follow_lane "));
    }
}

TEST_F(DriverBranch, KeepsTheLatencyOfTheScenario) {
    write_scenario("late", spawn("ego", 20, ", latency = 3"));
    drive("late", steady, "late.mcap");
    branch({"--driver", "ego=" + counting}, "b.mcap", 0, "late.mcap");
    for (const std::uint64_t tick : {50U, 51U, 53U})
        EXPECT_EQ(steer("b.mcap", tick), 0.125) << "the last control until the first answer acts";
    EXPECT_EQ(steer("b.mcap", 54) * 1024, 50);
    EXPECT_EQ(steer("b.mcap", 100) * 1024, 96);
    expect_equal("b.mcap", 100);
}

/// It is shown the tick in which it takes over, and then those that its predecessor would have
/// been.
TEST_F(DriverBranch, WhoTakesOverIsShownEachFewTicksAsTheScenarioSays) {
    write_scenario("few", spawn("ego", 20, ", every = 4"));
    drive("few", steady, "few.mcap");
    branch({"--driver", "ego=" + counting}, "b.mcap", 0, "few.mcap");
    EXPECT_EQ(steer("b.mcap", 50), 0.125);
    // Spawned in tick 1: ticks 49, 53, 57 and so on are shown.
    for (const auto& [tick, shown] : {std::pair<std::uint64_t, int>(51, 50),
                                      std::pair<std::uint64_t, int>(53, 50),
                                      std::pair<std::uint64_t, int>(54, 53),
                                      std::pair<std::uint64_t, int>(57, 53),
                                      std::pair<std::uint64_t, int>(58, 57)})
        EXPECT_EQ(steer("b.mcap", tick) * 1024, shown) << tick;
    expect_equal("b.mcap", 100);
}

TEST_F(DriverBranch, EachScriptHasADriverOfItsOwn) {
    branch({"--script", "brake.lua", "rain.lua", "--driver", "ego=" + counting}, "together");
    for (const std::string script : {"brake", "rain"}) {
        branch({"--script", script + ".lua", "--driver", "ego=" + counting}, "alone.mcap");
        EXPECT_TRUE(bytes("together/" + script + ".mcap") == bytes("alone.mcap")) << script;
        expect_equal("alone.mcap", 100);
    }
    EXPECT_EQ(steer("together/rain.mcap", 51) * 1024, 50);
}

TEST_F(DriverBranch, WithoutOneTheRecordedControlsGoOnAndThenItBrakes) {
    drive("one", counting, "counted.mcap");
    const std::string said =
        branch({"--script", "brake.lua", "--for", "5"}, "b.mcap", 0, "counted.mcap");
    EXPECT_THAT(said,
                HasSubstr("'ego' does what its driver did until tick 100, then it brakes; --driver "
                          "ego=COMMAND lets another one take over"));
    EXPECT_EQ(steer("b.mcap", 51) * 1024, 50);
    EXPECT_EQ(steer("b.mcap", 100) * 1024, 99);
    EXPECT_EQ(control("b.mcap", 100, 0).brake(), 0);
    EXPECT_EQ(control("b.mcap", 101, 0).brake(), 1);
    EXPECT_EQ(control("b.mcap", 150, 0).throttle(), 0);
    expect_equal("b.mcap", 150);
}

TEST_F(DriverBranch, OfTwoOneIsTakenOver) {
    write_scenario("two", spawn("ego", 40) + spawn("other", 15));
    run({"run",
         "two.lua",
         "--driver",
         "ego=" + counting,
         "--driver",
         "other=" + steady,
         "-o",
         "two.mcap"},
        0);
    const std::string said = branch({"--driver", "other=" + counting}, "b.mcap", 0, "two.mcap");
    EXPECT_THAT(said, HasSubstr("'ego' does what its driver did"));
    EXPECT_THAT(said, Not(HasSubstr("'other' does")));
    EXPECT_EQ(steer("b.mcap", 50, 1), 0.125);
    EXPECT_EQ(steer("b.mcap", 60, 0) * 1024, 59);
    EXPECT_EQ(steer("b.mcap", 60, 1) * 1024, 59);
    expect_equal("b.mcap", 100);
}

TEST_F(DriverBranch, WhoIsLostEndsItWhole) {
    EXPECT_THAT(branch({"--driver", "ego=" + odd_driver + " killed 70"}, "b.mcap", 1),
                HasSubstr("the driver of 'ego' was ended by signal 9"));
    expect_equal("b.mcap", 70);
    EXPECT_THAT(run({"info", "b.mcap"}, 0), HasSubstr("driver_lost: the driver of 'ego' was lost"));
    EXPECT_THAT(branch({"--driver", "ego=exit 7"}, "c.mcap", 1), HasSubstr("exit code 7"));
    expect_equal("c.mcap", 50);
}

TEST_F(DriverBranch, SaysWhatIsWrongAndLeavesNothing) {
    const auto before = folder_.files();
    EXPECT_THAT(branch({"--driver", "ego"}, "b.mcap", 2), HasSubstr("expected NAME=COMMAND"));
    EXPECT_THAT(branch({"--driver", "ego=a", "--driver", "ego=b"}, "b.mcap", 2),
                HasSubstr("'ego' has a driver already"));
    EXPECT_THAT(branch({"--script", "brake.lua", "rain.lua", "--driver", "ego=socket:s"}, "b", 2),
                HasSubstr("one driver comes there, and 2 scripts need one each"));
    write_script("more", spawn("third", 60) + "wait(1)");
    EXPECT_THAT(branch({"--script", "more.lua"}, "b.mcap", 2),
                HasSubstr("more.lua:2: spawn: 'third' is driven by another program: say which by "
                          "--driver third='COMMAND'"));
    fs::remove(folder_ / "more.lua");
    EXPECT_EQ(folder_.files(), before);
}

TEST_F(DriverBranch, ANameThatNobodyHasIsAMistake) {
    write_file(
        folder_ / "left.lua",
        "return scenario 'left' { town = 'small.net.xml', cars = 0, seed = 11, duration = 5,\n"
        "run = function()\n" +
            spawn("ego", 20) + spawn("gone", 40) +
            "spawn{ name = 'own', model = 'sedan', driver = 'autopilot', lane = 'am_1', s = "
            "60 }\nwait(1) gone:despawn() wait(60)\nend }\n");
    run({"run",
         "left.lua",
         "--driver",
         "ego=" + steady,
         "--driver",
         "gone=" + steady,
         "-o",
         "left.mcap"},
        0);
    write_script("later", "for i = 1, 2 do if i == 3 then spawn{ name = 'car_' .. i } end end");
    const auto before = folder_.files();
    EXPECT_THAT(branch({"--driver", "egoo=" + steady}, "b.mcap", 2, "left.mcap"),
                HasSubstr("--driver egoo: nobody is called that (did you mean 'ego'?); other "
                          "programs drive ego at 50t"));
    EXPECT_THAT(branch({"--driver", "gone=" + steady}, "b.mcap", 2, "left.mcap"),
                HasSubstr("--driver gone: at 50t 'gone' is there no longer"));
    EXPECT_THAT(branch({"--driver", "own=" + steady}, "b.mcap", 2, "left.mcap"),
                HasSubstr("--driver own: at 50t 'own' is driven by nobody in another program"));
    EXPECT_THAT(branch({"--script", "rain.lua", "brake.lua", "--driver", "egoo=" + steady}, "b", 2),
                HasSubstr("--driver egoo: nobody is called that"));
    // What looks alike is not the name.
    for (const std::string name : {"ego2", "7", "o"})
        EXPECT_THAT(branch({"--driver", name + "=" + steady}, "b.mcap", 2, "left.mcap"),
                    HasSubstr("--driver " + name + ": nobody is called that"));
    EXPECT_EQ(folder_.files(), before);
    // Who has no name of its own is called as its model.
    write_script("unnamed",
                 "for i = 1, 2 do spawn{ model = 'van', driver = 'external' } end wait(1)");
    branch({"--script", "unnamed.lua", "--driver", "van=" + steady, "--driver", "van_2=" + steady},
           "unnamed.mcap");
    // Who may still come is waited for.
    EXPECT_THAT(branch({"--script", "later.lua", "--driver", "car_2=" + steady}, "b.mcap"),
                HasSubstr("--driver car_2: nobody was spawned with that name"));
}

}  // namespace
}  // namespace reprise::test
