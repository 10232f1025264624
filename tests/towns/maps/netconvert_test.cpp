#include "towns/maps/netconvert.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "world/check.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A program of SUMO's that is a script of ours: it is found through PATH.
class SumoTool : public ::testing::Test {
  protected:
    SumoTool()
        : folder_(fs::path(::testing::TempDir()) / ("reprise tool, " + std::to_string(getpid()))),
          path_(std::getenv("PATH")) {
        fs::create_directories(folder_);
        setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
    }

    ~SumoTool() override {
        setenv("PATH", path_.c_str(), 1);
        fs::remove_all(folder_);
    }

    int run(const std::string& script) const {
        std::ofstream(folder_ / "toolconvert") << "#!/bin/sh\n" << script << "\n";
        fs::permissions(folder_ / "toolconvert", fs::perms::owner_all);
        return run_sumo_tool("toolconvert", {"-o", "a b"}, folder_, "x.osm");
    }

    std::string error_of(const std::string& script) const {
        try {
            run(script);
            return "";
        } catch (const world::Error& error) {
            return error.what();
        }
    }

    fs::path folder_;
    std::string path_;
};

TEST_F(SumoTool, RunsInItsFolderWithoutOurVariablesAndWithSchemaChecksOff) {
    setenv("LC_ALL", "de_DE.UTF-8", 1);
    setenv("SUMO_HOME", "/nowhere", 1);
    const std::string said =
        error_of("echo $(/usr/bin/env | /usr/bin/sort) in $(pwd) \"$@\" >all; exit 3");
    unsetenv("LC_ALL");
    unsetenv("SUMO_HOME");
    EXPECT_EQ(said, "x.osm: toolconvert refuses it: it did not say why");
    std::string all;
    std::getline(std::ifstream(folder_ / "all"), all);
    const std::string folder = fs::canonical(folder_).string();
    // PWD and _ are the shell's own.
    EXPECT_THAT(all, HasSubstr("LC_ALL=C PWD=" + folder + " SUMO_HOME=" + sumo_folder().string()));
    EXPECT_THAT(all, HasSubstr("in " + folder + " -o a b --xml-validation never"));
    EXPECT_THAT(all, ::testing::Not(HasSubstr("HOME=" + std::string(std::getenv("HOME")))));
}

TEST_F(SumoTool, CountsItsWarnings) {
    EXPECT_EQ(run("echo Warning: a; echo b; echo Warning: c >&2"), 2);
}

TEST_F(SumoTool, ThatCrashesIsToldAsSuchWithWhatItSaid) {
    EXPECT_EQ(error_of("echo Error: too odd; kill -SEGV $$"),
              "x.osm: toolconvert crashed (signal 11, Segmentation fault): too odd");
}

TEST_F(SumoTool, ThatIsNotThereIsNamedWithItsPackage) {
    EXPECT_THAT(
        [&] { run_sumo_tool("netconvert_of_nobody", {}, folder_, "x.osm"); },
        ::testing::ThrowsMessage<world::Error>("netconvert_of_nobody: there is no such program "
                                               "here; it is in Debian's package sumo"));
}

TEST(Reason, IsTheErrorsInOneLine) {
    EXPECT_EQ(reason_in("Warning: x\nError: unexpected end of input\n In file 'a.osm'\n At "
                        "line/column 2/10.\n\nQuitting (on error).\n"),
              "unexpected end of input (line/column 2/10)");
    EXPECT_EQ(reason_in("Error: a\nError: a\nError: b\nError: c\nError: d\n"),
              "a; b; c; and 1 more");
    EXPECT_EQ(reason_in("Error: No nodes loaded.\n"), "No nodes loaded: it has no roads");
    EXPECT_EQ(reason_in("terminate called\nwhat(): \x1b[2J\n"), R"(what(): \x1b[2J)");
    EXPECT_EQ(reason_in("\n"), "it did not say why");
}

}  // namespace
}  // namespace reprise::towns
