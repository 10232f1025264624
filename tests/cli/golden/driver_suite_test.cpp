// reprise test where another program drives: no golden, the checks count.
#include "tests/cli/drivers.h"

namespace reprise::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string steady = "ego=" + odd_driver + " steady";

class DriverSuite : public Drivers {
  protected:
    void SetUp() override {
        Drivers::SetUp();
        write_checked(100);
    }

    void write_checked(int fastest) const {
        write_scenario(
            "one",
            spawn("ego", 20) +
                fmt::format("check.max('speed', function() return ego:speed() end, {})\n",
                            fastest));
    }
};

TEST_F(DriverSuite, WithoutADriverACaseIsNotRunAndDoesNotPass) {
    const std::string said = run({"test", "--junit", "results.xml"}, 1);
    EXPECT_THAT(said,
                AllOf(HasSubstr("NOT RUN   one  another program drives, and none was named"),
                      HasSubstr("reprise test one.lua --driver NAME='COMMAND'"),
                      HasSubstr("0 passed, 0 changed, 0 nondeterministic, 1 not run")));
    EXPECT_THAT(bytes("results.xml"), HasSubstr("<failure type=\"not_run\""));
    EXPECT_THAT(run({"test", "--list"}, 0),
                HasSubstr("one  (checks only: another program drives)"));
}

TEST_F(DriverSuite, WithOneItPassesByItsChecks) {
    for (const std::string& driver : {steady, "ego=" + python_driver})
        EXPECT_THAT(run({"test", "one.lua", "--driver", driver}, 0),
                    AllOf(HasSubstr("passed    one  checks only: verdict passed, 1 check"),
                          HasSubstr("1 passed, 0 changed")));
    EXPECT_FALSE(fs::exists(folder_ / "reprise-test"));
}

TEST_F(DriverSuite, FailedChecksAreToldAndTheTraceIsKept) {
    write_checked(1);
    const std::string said =
        run({"test", "--driver", steady, "--driver-timeout", "60", "--junit", "results.xml"}, 1);
    EXPECT_THAT(said,
                AllOf(HasSubstr("FAILED    one  checks only: verdict failed, 1 check"),
                      HasSubstr("checks    speed: failed at "),
                      HasSubstr("0 passed, 0 changed, 0 nondeterministic, 1 failed")));
    EXPECT_THAT(bytes("results.xml"),
                AllOf(HasSubstr("<failure type=\"failed\""),
                      HasSubstr("--driver 'ego=" + odd_driver + " steady' --driver-timeout 60")));
    expect_equal("reprise-test/one.mcap", 100);
    write_checked(100);
    run({"test", "--driver", steady}, 0);
    EXPECT_FALSE(fs::exists(folder_ / "reprise-test")) << "what failed before lies there still";
}

TEST_F(DriverSuite, ADriverThatIsLostFailsIt) {
    const std::string said = run({"test", "--driver", "ego=" + odd_driver + " killed 30"}, 1);
    EXPECT_THAT(said,
                AllOf(HasSubstr("FAILED    one  checks only: verdict driver_lost"),
                      HasSubstr("the driver of 'ego' was ended by signal 9")));
    expect_equal("reprise-test/one.mcap", 30);
}

TEST_F(DriverSuite, OthersAreComparedWithTheirGoldensAsEver) {
    write_scenario("plain", "spawn{ name = 'ego', model = 'sedan', lane = 'am_1', s = 20 }\n");
    run({"accept", "plain.lua", "--because", "first"}, 0);
    const std::string said = run({"test", "--driver", steady}, 0);
    EXPECT_THAT(said,
                AllOf(HasSubstr("passed    one  checks only"),
                      HasSubstr("passed    plain  equal, verdict completed"),
                      HasSubstr("2 passed")));
    EXPECT_THAT(run({"test"}, 1), HasSubstr("1 passed, 0 changed, 0 nondeterministic, 1 not run"));
    EXPECT_THAT(run({"test", "plain.lua", "--driver", steady}, 2),
                HasSubstr("none of these scenarios has a car that another program drives"));
}

TEST_F(DriverSuite, ADriverWhoseNameNobodyHadIsAMistake) {
    write_scenario("two", spawn("other", 20));
    const auto test = [&](const std::string& third, int code) {
        return run({"test",
                    "--driver",
                    steady,
                    "--driver",
                    "other=" + odd_driver + " steady",
                    "--driver",
                    third + "=" + odd_driver + " steady"},
                   code);
    };
    EXPECT_THAT(test("othre", 2),
                AllOf(HasSubstr("2 passed"),
                      HasSubstr("reprise: --driver othre="),
                      HasSubstr(": no car of that name was driven by another program in any of "
                                "these scenarios (did you mean 'other'?)")));
    EXPECT_THAT(test("ego ", 2), HasSubstr("did you mean 'ego'?"));
    EXPECT_THAT(run({"test", "one.lua", "--driver", steady, "--driver", "other=true"}, 2),
                HasSubstr("--driver other=true: no car of that name"));
    EXPECT_THAT(run({"test",
                     "--driver",
                     steady,
                     "--driver",
                     "other=" + odd_driver + " killed 30",
                     "--driver",
                     "late=true"},
                    1),
                Not(HasSubstr("no car of that name")))
        << "it might have come later";
}

TEST_F(DriverSuite, SaysWhatIsWrong) {
    EXPECT_THAT(run({"accept", "one.lua", "--because", "it drives"}, 2),
                HasSubstr("only their checks are tested: reprise test --driver"));
    EXPECT_FALSE(fs::exists(folder_ / "one.golden"));
    for (const char* place : {"ego=socket:s.sock", "ego=tcp:2000"})
        EXPECT_THAT(run({"test", "--driver", place}, 2), HasSubstr("add --jobs 1"));
    EXPECT_THAT(run({"test", "--driver", "ego=tcp:0", "--jobs", "1"}, 2),
                HasSubstr("--driver ego=tcp:0: nobody would hear which port is free"));
    EXPECT_THAT(run({"test", "--driver", "ega=true"}, 2),
                HasSubstr("ERROR     one  one.lua:3: spawn: 'ego' is driven by another program"));
}

}  // namespace
}  // namespace reprise::test
