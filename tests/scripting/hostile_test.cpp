#include "tests/scripting/hostile.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "process/program.h"

// No tick and no load takes longer than 2 s of the processor's time, whatever the script.
namespace reprise::test {

namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

#ifdef __SANITIZE_ADDRESS__
constexpr process::Limits limits{.seconds = 100};  // sanitizers take 20 times as long
#else
constexpr process::Limits limits{.memory = std::uint64_t{1200} << 20U, .seconds = 2};
#endif

constexpr const char* megabyte = "more than 1 MB";

class HostileScript : public testing::TestWithParam<Hostile> {};

std::string name_of(const testing::TestParamInfo<Hostile>& info) {
    return info.param.name;
}

}  // namespace

TEST_P(HostileScript, EndsWithAMistakeInItsLineWithinTwoSeconds) {
    const Hostile& script = GetParam();
    const auto file =
        std::filesystem::temp_directory_path() / ("hostile_" + std::to_string(::getpid()) + ".lua");
    std::ofstream(file, std::ios::binary) << script.source.made();
    const process::ProgramResult played = process::run_program({.name = REPRISE_PLAY_SCENARIO,
                                                                .words = {file.string(), "10000"},
                                                                .most_said = 1 << 20,
                                                                .limits = limits});
    std::filesystem::remove(file);
    EXPECT_EQ(played.stopped, "");
    EXPECT_EQ(played.code, script.message.empty() ? 0 : 2);
    const std::size_t last = played.said.find_last_of('\n', played.said.size() - 2);
    const std::string end = played.said.substr(last == std::string::npos ? 0 : last + 1);
    EXPECT_THAT(end, HasSubstr(script.message.empty() ? "scenario ended" : script.message));
    // All but what is said of the file as a whole.
    if (!script.message.empty() && script.message != megabyte) {
        EXPECT_THAT(end, ContainsRegex("test\\.lua:[0-9]+: "));
    }
}

INSTANTIATE_TEST_SUITE_P(Load, HostileScript, testing::ValuesIn(hostile_loads()), name_of);
INSTANTIATE_TEST_SUITE_P(Work, HostileScript, testing::ValuesIn(hostile_works()), name_of);
INSTANTIATE_TEST_SUITE_P(Text, HostileScript, testing::ValuesIn(hostile_texts()), name_of);
INSTANTIATE_TEST_SUITE_P(Ask, HostileScript, testing::ValuesIn(hostile_asks()), name_of);

}  // namespace reprise::test
