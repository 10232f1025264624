#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "process/program.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "tests/cli/program.h"

namespace reprise::test {

inline const std::string odd_driver = ODD_DRIVER;
inline const std::string python_driver = PYTHON " -B driver.py";

/// Five seconds on a small network, with cars that other programs drive.
class Drivers : public testing::Test {
  protected:
    void SetUp() override {
        std::filesystem::copy_file(source("tests/cli/crash/small.net.xml"),
                                   folder_ / "small.net.xml");
        write_scenario("one", spawn("ego", 20));
        write_file(folder_ / "driver.py",
                   "import reprise\n"
                   "reprise.drive(lambda seen: reprise.Control("
                   "throttle=0.3 if seen.ego.speed < 4 else 0, steer=-0.01))\n");
    }

    static std::string spawn(const std::string& name, int s, const std::string& more = "") {
        return fmt::format(
            "local {0} = spawn{{ name = '{0}', model = 'sedan', driver = 'external', lane = "
            "'am_1', s = {1}{2} }}\n",
            name,
            s,
            more);
    }

    void write_scenario(const std::string& name, const std::string& body) const {
        write_file(folder_ / (name + ".lua"),
                   "return scenario '" + name +
                       "' { town = 'small.net.xml', cars = 0, seed = 11, duration = 5,\n"
                       "params = { word = 'hello' }, run = function(p)\n" +
                       body + "wait(4) print(p.word) wait(60)\nend }\n");
    }

    std::string run(const std::vector<std::string>& words,
                    int code,
                    const std::vector<std::string>& variables = {}) const {
        std::vector<std::string> all{"PYTHONPATH=" + source("python")};
        all.insert(all.end(), variables.begin(), variables.end());
        const auto result = process::run_program(
            {.name = REPRISE_PROGRAM, .words = words, .folder = folder_.path(), .variables = all});
        EXPECT_EQ(result.signal == 0 ? result.code : 128 + result.signal, code) << result.said;
        return result.said;
    }

    /// `reprise run NAME.lua -o TRACE` with one driver for 'ego'.
    std::string drive(const std::string& name,
                      const std::string& driver,
                      const std::string& trace,
                      int code = 0) const {
        return run({"run", name + ".lua", "--driver", "ego=" + driver, "-o", trace}, code);
    }

    std::string bytes(const std::string& name) const { return read_file(folder_ / name); }

    void expect_equal(const std::string& trace, std::uint64_t ticks) const {
        EXPECT_THAT(run({"verify", trace}, 0),
                    testing::HasSubstr(fmt::format("equal at every one of {} tick", ticks)));
    }

    /// A copy of a trace, of `ticks` ticks, that says it ended so.
    void forge(const std::string& from, std::uint64_t ticks, const world::Outcome& outcome) const {
        replay::TraceReader trace(folder_ / from);
        replay::TraceWriter forged(folder_ / "forged.mcap", trace.recording());
        for (std::uint64_t index = 1; index <= ticks; ++index)
            forged.append(trace.tick(index));
        forged.close(outcome);
    }

    const Folder folder_;
};

}  // namespace reprise::test
