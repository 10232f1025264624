#include <algorithm>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

struct Mistake {
    const char* name;
    const char* scenario;  ///< Lua source; null: free_drive
    std::vector<std::string> words;
    std::vector<std::string> said;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << mistake.name;
}

class Mistakes : public testing::TestWithParam<Mistake> {};

/// One line, exit 2, nothing left behind.
TEST_P(Mistakes, AreToldInOneLine) {
    const Mistake& mistake = GetParam();
    const Folder inputs;
    const Folder folder;
    std::string scenario = source("scenarios/free_drive.lua");
    if (mistake.scenario != nullptr) {
        scenario = inputs / "mine.lua";
        write_file(scenario, mistake.scenario);
    }
    write_file(inputs / "empty.net.xml", "");
    write_file(inputs / "broken.net.xml", "<net version=\"1.9\">\n  <edge id=\n</net>");
    write_file(inputs / "other.net.xml", "<html></html>");
    std::string wide = read_file(source("scenarios/towns/town1/town1.net.xml"));
    wide.replace(wide.find("width=\"3.500\"", wide.find("<lane ")), 13, "width=\"-1\"");
    write_file(inputs / "wide.net.xml", wide);
    std::vector<std::string> words{"run", scenario, "-o", folder / "t.mcap", "--for", "1"};
    for (std::string word : mistake.words) {
        if (const auto at = word.find('@'); at != std::string::npos)
            word.replace(at, 1, inputs / "");
        words.push_back(word);
    }
    const Result result = reprise(words, folder.path());
    EXPECT_EQ(result.code, 2) << result.out;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
    for (const std::string& text : mistake.said)
        EXPECT_THAT(result.out, HasSubstr(text));
    EXPECT_THAT(folder.files(), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Run,
    Mistakes,
    testing::Values(
        Mistake{"BrokenLua", "return scenario 'x' {\n  run = function(\n}", {}, {"mine.lua:"}},
        Mistake{"EmptyLua", "", {}, {"mine.lua"}},
        Mistake{"UnknownHeaderKey",
                "return scenario 'x' {\n  cras = 5,\n  run = function() end }",
                {},
                {"mine.lua:", "cras", "did you mean 'cars'?"}},
        Mistake{"UnknownModel",
                "return scenario 'x' { town = 'town1', run = function()\n  spawn{ model = 'sedna', "
                "driver = 'autopilot' }\nend }",
                {},
                {"mine.lua:2", "sedna", "did you mean 'sedan'?"}},
        Mistake{"UnknownSpawnKey",
                "return scenario 'x' { town = 'town1', run = function()\n  spawn{ modle = 'sedan' "
                "}\nend }",
                {},
                {"mine.lua:2", "modle", "did you mean 'model'?"}},
        Mistake{"UnknownParameter", nullptr, {"--set", "gpa=3"}, {"gpa"}},
        Mistake{"UnknownTown", nullptr, {"--town", "town3"}, {"town3", "town1"}},
        Mistake{"MissingNetwork", nullptr, {"--town", "@none.net.xml"}, {"none.net.xml"}},
        Mistake{"EmptyNetwork", nullptr, {"--town", "@empty.net.xml"}, {"empty.net.xml"}},
        Mistake{"BrokenNetwork", nullptr, {"--town", "@broken.net.xml"}, {"broken.net.xml:"}},
        Mistake{"NotANetwork", nullptr, {"--town", "@other.net.xml"}, {"other.net.xml"}},
        Mistake{"UnwritableOutput", nullptr, {"-o", "/proc/t.mcap"}, {"/proc/t.mcap"}},
        Mistake{"NotAFile", nullptr, {"--town", "/dev/zero"}, {"/dev/zero", "not a file"}},
        Mistake{"ImpossibleWidth",
                nullptr,
                {"--town", "@wide.net.xml"},
                {"wide.net.xml:", "width=\"-1\"", "above 0"}},
        Mistake{"NudgeBehindTheEnd", nullptr, {"--nudge", "21"}, {"--nudge 21", "1 to 20"}},
        Mistake{"NudgeOfNoField",
                nullptr,
                {"--nudge", "5:ego.velocty.x"},
                {"no recorded number is called 'velocty.x'", "did you mean 'velocity.x'?"}},
        Mistake{"NudgeOfNoTick", nullptr, {"--nudge", "ego.speed"}, {"TICK"}},
        Mistake{"EmptyOutput", nullptr, {"-o", ""}, {"--output", "path"}},
        Mistake{"EmptySet", nullptr, {"--set", ""}, {"--set"}},
        Mistake{"EmptyLevel", nullptr, {"--level", ""}, {"--level"}},
        Mistake{"EmptyDriver", nullptr, {"--driver", ""}, {"--driver"}},
        Mistake{"NegativeSeed", nullptr, {"--seed", "-1"}, {"seed", "whole number"}},
        Mistake{"SeedTooLarge", nullptr, {"--seed", "18446744073709551616"}, {"whole number"}},
        Mistake{"BadSeed", nullptr, {"--seed", "seven"}, {"seed"}},
        Mistake{"BadDuration", nullptr, {"--for", "-3"}, {"for"}}),
    [](const testing::TestParamInfo<Mistake>& tested) { return tested.param.name; });

TEST(Mistakes, MissingScenarioIsNamed) {
    const Result result = reprise({"run", "no_such.lua"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("no_such.lua"));
}

TEST(Mistakes, WhatIsRunIsNotWrittenOver) {
    const Folder folder;
    const std::string scenario =
        "return scenario 'mine' { town = 'straight', duration = 0.1, run = function() wait(1) end "
        "}\n";
    write_file(folder / "mine.lua", scenario);
    std::filesystem::create_symlink("mine.lua", folder / "link.mcap");
    for (const char* output : {"mine.lua", "./mine.lua", "link.mcap"}) {
        const Result result = reprise({"run", "mine.lua", "-o", output}, folder.path());
        EXPECT_EQ(result.code, 2);
        EXPECT_THAT(result.out, HasSubstr(std::string(output) + ": the output is the input"));
        EXPECT_EQ(read_file(folder / "mine.lua"), scenario);
    }
    EXPECT_EQ(reprise({"run", "mine.lua", "-o", "a.mcap"}, folder.path()).code, 0);
    const std::string trace = read_file(folder / "a.mcap");
    EXPECT_EQ(reprise({"run", "a.mcap", "--for", "0.05", "-o", "a.mcap"}, folder.path()).code, 2);
    EXPECT_EQ(read_file(folder / "a.mcap"), trace);
}

TEST(Mistakes, WhatIsNotATraceIsSaidSo) {
    const Folder folder;
    write_file(folder / "not.mcap",
               "this is not a trace at all, only some text that is long enough");
    write_file(folder / "empty.mcap", "");
    for (const char* command : {"info", "verify"})
        for (const char* name : {"not.mcap", "empty.mcap", "missing.mcap"}) {
            const Result result = reprise({command, folder / name});
            EXPECT_EQ(result.code, 2) << result.out;
            EXPECT_THAT(result.out, HasSubstr(name));
        }
}

TEST(Mistakes, UnknownCommandsAndOptionsAreUsageErrors) {
    const Result command = reprise({"rnu"});
    EXPECT_EQ(command.code, 2);
    EXPECT_THAT(command.out, HasSubstr("no command 'rnu' (did you mean 'run'?)"));
    EXPECT_EQ(reprise({}).code, 2);
    EXPECT_EQ(reprise({"run", "x.lua", "--sede", "3"}).code, 2);
    const Result weather = reprise({"render", "t.mcap", "-o", "d", "--weather", "clear_nono"});
    EXPECT_EQ(weather.code, 2);
    EXPECT_THAT(weather.out, HasSubstr("did you mean 'clear_noon'?"));
}

TEST(Help, IsEverywhere) {
    EXPECT_EQ(reprise({"--help"}).code, 0);
    EXPECT_EQ(reprise({"--version"}).code, 0);
    for (const char* command :
         {"run", "verify", "info", "diff", "recover", "render", "test", "accept", "golden"})
        EXPECT_EQ(reprise({command, "--help"}).code, 0) << command;
}

/// A shell's variable that is not set must not be taken for nothing: least of all where it is a
/// token.
TEST(Options, WithoutATextAreTold) {
    const Folder folder;
    const std::vector<std::vector<std::string>> lines{
        {"render", "no.mcap", "-o", "x", "--rig", ""},
        {"render", "no.mcap", "-o", "x", "--ticks", ""},
        {"cat", "no.mcap", "--actor", ""},
        {"test", "no.lua", "--junit", ""},
        {"serve", "--port", "0", "--listen", "0.0.0.0", "--token-file", ""},
        {"serve", "--port", ""},
        {"town", "show", "town1", "-o", ""},
    };
    for (const auto& line : lines) {
        const Result result = reprise(line, folder.path());
        EXPECT_EQ(result.code, 2) << result.out;
        EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
        EXPECT_THAT(result.out, testing::AllOf(HasSubstr("expected "), HasSubstr("got ''")));
    }
    EXPECT_THAT(folder.files(), testing::IsEmpty());
}

}  // namespace
}  // namespace reprise::test
