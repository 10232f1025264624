// What README.md shows first is run as it stands there.
#include <sstream>

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

}  // namespace
}  // namespace reprise::test
