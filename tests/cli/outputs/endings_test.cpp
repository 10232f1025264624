// What is left when a signal ends a command, at every call that changes files.
#include <algorithm>
#include <csignal>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "process/program.h"
#include "tests/cli/outputs/commands.h"

namespace reprise::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Endings : public testing::TestWithParam<WritingCommand> {
  protected:
    void SetUp() override { give_inputs(folder_); }

    process::ProgramResult ended_at(int call, int signal, bool after) {
        std::vector<std::string> variables{"LD_PRELOAD=" REPRISE_RAISE_AT,
                                           "TMPDIR=" + (folder_ / "tmp"),
                                           fmt::format("RAISE_AT={}", call),
                                           fmt::format("RAISE_SIGNAL={}", signal)};
        if (after)
            variables.emplace_back("RAISE_AFTER=1");
        return process::run_program({.name = REPRISE_PROGRAM,
                                     .words = GetParam().to("out.mcap"),
                                     .folder = folder_.path(),
                                     .variables = variables});
    }

    std::set<std::string> all() const {
        std::set<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
            names.insert(fs::relative(entry.path(), folder_.path()).string());
        return names;
    }

    /// What a whole run leaves besides.
    static bool is_result(const std::string& name) {
        const bool is_ours = name.starts_with("out.mcap") || name.starts_with("reprise-test");
        return is_ours && !name.ends_with(".partial") && !name.ends_with(".recovered");
    }

    const Folder folder_;
};

/// Calls of one command are many; the first ones, and then ever fewer of them.
int next_call(int call) {
    return call < 7 ? call + 1 : call + call / 2;
}

/// Whether the signal was what ended it: the command itself, or a copy of it that worked for it.
bool is_ended_by(const process::ProgramResult& result, int signal) {
    return result.signal == signal || result.code == 128 + signal ||
           (result.code == 2 && result.said.find("stopped (") != std::string::npos);
}

TEST_P(Endings, LeaveNothingUnfinished) {
    fs::create_directory(folder_ / "tmp");
    const bool keeps = GetParam().name == "Run";
    const std::set<std::string> before = all();
    int signals = 0;
    for (int call = 1, through = 0; through < 2; call = next_call(call)) {
        through = 0;
        for (const bool after : {false, true}) {
            const int signal = call % 2 == 0 ? SIGTERM : SIGINT;
            const auto result = ended_at(call, signal, after);
            const bool ended = is_ended_by(result, signal);
            EXPECT_TRUE(ended || result.code == 0 || result.code == 3) << result.said;
            signals += ended ? 1 : 0;
            through += ended ? 0 : 1;
            for (const std::string& name : all()) {
                const bool rest = keeps && name == "out.mcap.partial";
                EXPECT_TRUE(before.count(name) > 0 || is_result(name) || rest)
                    << name << " at call " << call << ": " << result.said;
            }
            fs::remove_all(folder_ / "out.mcap");
            fs::remove(folder_ / "out.mcap.partial");
        }
        ASSERT_LT(call, 10'000);
    }
    EXPECT_GT(signals, 1);
}

TEST(Interrupted, RunsKeepEveryTickAndSayHowToGetThem) {
    const Folder folder;
    // So long that it cannot end between the signal and the thread that waits for signals, which
    // a busy machine lets wait for seconds' worth of ticks.
    write_file(folder / "drive.lua",
               "return scenario 'drive' { town = 'town1', duration = 600, run = function() "
               "spawn{ name = 'ego', model = 'sedan' } wait(600) end }");
    std::smatch found;
    // Whichever call is the first behind which ticks were recorded.
    for (int call = 1; found.empty() && call < 100; ++call) {
        const auto result =
            process::run_program({.name = REPRISE_PROGRAM,
                                  .words = {"run", "drive.lua", "-o", "t.mcap"},
                                  .folder = folder.path(),
                                  .variables = {"LD_PRELOAD=" REPRISE_RAISE_AT,
                                                fmt::format("RAISE_AT={}", call),
                                                fmt::format("RAISE_SIGNAL={}", SIGINT)}});
        const std::regex told(R"(reprise: stopped \(Interrupt\) behind tick (\d+); [^:]*: (.*))");
        std::string said = result.said;
        if (!std::regex_search(said, found, told))
            continue;
        EXPECT_EQ(result.code, 128 + SIGINT);
        EXPECT_FALSE(fs::exists(folder / "t.mcap"));
        const Result recovered = typed(found[2], folder);
        EXPECT_EQ(recovered.code, 3) << recovered.out;
        EXPECT_THAT(recovered.out, HasSubstr("t.mcap: " + found[1].str() + " ticks ("));
        EXPECT_EQ(reprise({"verify", "t.mcap"}, folder.path()).code, 0);
        return;
    }
    FAIL() << "no run was interrupted behind a tick";
}

INSTANTIATE_TEST_SUITE_P(Every,
                         Endings,
                         testing::ValuesIn(writing_commands()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace reprise::test
