// What README.md shows first is run as it stands there.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

/// The section behind this heading.
std::string section(const std::string& heading) {
    const std::string all = read_file(source("README.md"));
    const auto begin = all.find("\n## " + heading + "\n");
    EXPECT_NE(begin, std::string::npos) << heading;
    return begin == std::string::npos ? ""
                                      : all.substr(begin, all.find("\n## ", begin + 1) - begin);
}

/// The code in this language.
std::string block(const std::string& text, const std::string& language) {
    const std::string mark = "```" + language + "\n";
    const auto begin = text.find(mark);
    EXPECT_NE(begin, std::string::npos) << language;
    const auto end = text.find("```", begin + mark.size());
    return text.substr(begin + mark.size(), end - begin - mark.size());
}

TEST(Readme, ItsDriverDrivesAsItIsShown) {
    const std::string text = section("Your driver");
    const Folder folder;
    write_file(folder / "drive.lua", block(text, "lua"));
    write_file(folder / "my_driver.py", block(text, "python"));
    // Debian's Python has what it needs; the package is where it lies in the project's folder.
    const std::string before = "PATH=$(dirname " PYTHON
                               "):$PATH PYTHONDONTWRITEBYTECODE=1 PYTHONPATH='" +
                               source("python") + "'; export PYTHONPATH PYTHONDONTWRITEBYTECODE; ";
    std::istringstream lines(text);
    int commands = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("    reprise "))
            continue;
        ++commands;
        const Result result = typed(before + line, folder);
        EXPECT_EQ(result.code, 0) << line << "\n" << result.out;
    }
    EXPECT_EQ(commands, 4);
}

/// The commands of README.md as they stand there, in order; without blocks that begin with the
/// comment "by hand: ...", which says why.
std::vector<std::string> commands_of(const std::string& text) {
    std::vector<std::string> commands;
    std::istringstream lines(text);
    bool by_hand = false;
    bool in_code = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("<!-- by hand: "))
            by_hand = true;
        if (line.starts_with("```"))
            in_code = !in_code;
        const bool is_command = !in_code && line.starts_with("    ");
        if (is_command && !by_hand)
            commands.push_back(line.substr(4));
        if (!is_command && !line.empty() && !line.starts_with("<!-- "))
            by_hand = false;
    }
    return commands;
}

/// What its comment promises; a check of a scenario may fail as well (1).
int promised_code(const std::string& command) {
    for (const int code : {1, 3})
        if (command.find(fmt::format("exit {}", code)) != std::string::npos)
            return code;
    return command.find("named at tick") != std::string::npos      ? 1
           : command.find("the first effect") != std::string::npos ? 1
           : command.find("different builds") != std::string::npos ? 0
                                                                   : 0;
}

class ReadmePastes : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Section,
                         ReadmePastes,
                         testing::Values("A scenario", "What it does"),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::replace(name.begin(), name.end(), ' ', '_');
                             return name;
                         });

TEST_P(ReadmePastes, EveryCommandAsItStandsInAFreshFolder) {
    const Folder folder;
    for (const char* part : {"scenarios", "examples", "tests", "python"})
        std::filesystem::create_directory_symlink(source(part), folder.path() / part);
    write_file(folder / "child.lua", block(section("A scenario"), "lua"));
    int ran = 0;
    for (const std::string& command : commands_of(section(GetParam()))) {
        ++ran;
        const Result result = typed(command, folder);
        EXPECT_EQ(result.code, promised_code(command)) << command << "\n" << result.out;
    }
    EXPECT_GE(ran, GetParam() == std::string("A scenario") ? 1 : 25);
}

}  // namespace
}  // namespace reprise::test
