// What is left of a run that was killed, crashed, or filled the disk, and of a damaged trace.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <regex>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Prints a long line in every tick and would go on for an hour.
constexpr const char* talker =
    "return scenario 'talker' { town = 'town1', seed = 5, duration = 3600, run = function()\n"
    "  spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' }\n"
    "  local i = 0\n"
    "  while true do\n"
    "    wait(0.05)\n"
    "    i = i + 1\n"
    "    print(string.rep('.', 120) .. i)\n"
    "  end\n"
    "end }";

struct Ended {
    int status = 0;   ///< as waitpid gives it
    std::string err;  ///< stderr
};

/// Starts a run of the talker and sends it a signal when it has come to that tick. The run cannot
/// be far ahead, and never ends by itself: what it prints goes into a pipe that nobody empties.
Ended interrupted_run(const Folder& folder, int signal, std::uint64_t at_tick) {
    write_file(folder / "talker.lua", talker);
    int out[2];
    EXPECT_EQ(pipe(out), 0);
    const std::string errors = folder / "stderr.txt";
    const pid_t child = fork();
    if (child == 0) {
        dup2(out[1], STDOUT_FILENO);
        close(out[0]);
        close(out[1]);
        if (chdir(folder.path().c_str()) == 0 && freopen(errors.c_str(), "w", stderr) != nullptr)
            execl(REPRISE_PROGRAM, "reprise", "run", "talker.lua", "-o", "t.mcap", nullptr);
        _exit(127);
    }
    close(out[1]);
    const std::string wanted = "." + std::to_string(at_tick) + "\n";
    std::string said;
    char part[4096];
    for (ssize_t size = 1; size > 0 && said.find(wanted) == std::string::npos;) {
        size = read(out[0], part, sizeof(part));
        said.append(part, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    }
    EXPECT_THAT(said, HasSubstr(wanted));
    kill(child, signal);
    Ended ended;
    EXPECT_EQ(waitpid(child, &ended.status, 0), child);
    close(out[0]);
    ended.err = read_file(errors);
    fs::remove(errors);
    return ended;
}

/// How many ticks a report says were recovered; they must be what a simulation gives again.
std::uint64_t recovered(const Result& report, const std::string& trace) {
    EXPECT_EQ(report.code, 3) << report.out;
    EXPECT_THAT(report.out, HasSubstr("  lost      all behind tick "));
    std::smatch found;
    EXPECT_TRUE(std::regex_search(report.out, found, std::regex(R"(: (\d+) ticks \()")));
    const std::uint64_t ticks = found.empty() ? 0 : std::stoull(found[1]);
    const Result verify = reprise({"verify", trace});
    EXPECT_EQ(verify.code, 0) << verify.out;
    EXPECT_THAT(verify.out, HasSubstr("every one of " + std::to_string(ticks) + " ticks"));
    return ticks;
}

/// A run writes while it simulates: of 600 ticks nine chunks are full, at most four on their way.
constexpr std::uint64_t stop_at = 600;
constexpr std::uint64_t surely_written = 64 * (stop_at / 64 - 4);

TEST(Recover, KeepsEveryWholeChunkOfARunThatWasKilled) {
    const Folder folder;
    const Ended ended = interrupted_run(folder, SIGKILL, stop_at);
    EXPECT_TRUE(WIFSIGNALED(ended.status));
    EXPECT_THAT(folder.files(), testing::ElementsAre("t.mcap.partial", "talker.lua"));
    // The name that comes to mind: where the run itself would have written through this very file.
    const std::string partial = read_file(folder / "t.mcap.partial");
    const Result report = reprise({"recover", "t.mcap.partial", "-o", "t.mcap"}, folder.path());
    const std::uint64_t ticks = recovered(report, folder / "t.mcap");
    EXPECT_GE(ticks, surely_written);
    EXPECT_EQ(ticks % 64, 0U);
    EXPECT_THAT(folder.files(), testing::ElementsAre("t.mcap", "t.mcap.partial", "talker.lua"));
    EXPECT_TRUE(read_file(folder / "t.mcap.partial") == partial);
}

/// The command at the end of a message.
std::string command_in(const std::string& text) {
    const std::size_t at = text.find("reprise recover ");
    EXPECT_NE(at, std::string::npos) << text;
    return at == std::string::npos ? "false" : text.substr(at, text.find('\n', at) - at);
}

TEST(Recover, AScriptsMistakeInMidRunSaysWhereTheTicksAreAndTheCommandThatSavesThem) {
    const Folder folder;
    write_file(folder / "slip.lua",
               "return scenario 'slip' { town = 'town1', run = function()\n"
               "  wait(5)\n"
               "  local ego = spawn{ model = 'sedna' }\n"
               "end }");
    const Result run = reprise({"run", "slip.lua", "-o", "t.mcap"}, folder.path());
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1) << run.out;
    EXPECT_THAT(run.out, HasSubstr("slip.lua:3: spawn: no model 'sedna'"));
    EXPECT_EQ(recovered(typed(command_in(run.out), folder), folder / "t.mcap"), 100U);
}

TEST(Crash, SaysWhereTheTicksAreAndTheCommandThatSavesThem) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "crashes are the sanitizer's to report";
#endif
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) {
        const Folder folder;
        const Ended ended = interrupted_run(folder, signal, stop_at);
        ASSERT_TRUE(WIFEXITED(ended.status));
        EXPECT_EQ(WEXITSTATUS(ended.status), 70);
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr("t.mcap.partial"));
        const Result report = typed(command_in(ended.err), folder);
        EXPECT_GE(recovered(report, folder / "t.mcap"), surely_written);
    }
}

/// The talker on a disk that has no room for it: `limit` is a shell's words that make it so.
void expect_recoverable_when_full(const std::string& limit, const Folder& folder) {
    write_file(folder / "talker.lua", talker);
    const Result run = run_program(
        "/bin/sh",
        {"-c", limit + " exec '" + REPRISE_PROGRAM + "' run talker.lua -o t.mcap > /dev/null"},
        folder.path());
    EXPECT_EQ(run.code, 2) << run.out;
    EXPECT_THAT(run.out, HasSubstr("reprise: t.mcap: cannot write the trace: "));
    EXPECT_THAT(run.out, HasSubstr("what was recorded until then is in t.mcap.partial"));
    EXPECT_FALSE(fs::exists(folder / "t.mcap"));
    const Folder elsewhere;
    const Result report =
        reprise({"recover", folder / "t.mcap.partial", "-o", elsewhere / "t.mcap"});
    EXPECT_GE(recovered(report, elsewhere / "t.mcap"), 64U);
}

TEST(Recover, KeepsWhatFittedUnderAFileSizeLimit) {
    expect_recoverable_when_full("ulimit -f 600;", Folder());
}

TEST(Recover, KeepsWhatFittedOnAFullDisk) {
    const Folder folder;
    const std::string place = folder.path();
    if (run_program("mount", {"-t", "tmpfs", "-o", "size=300k", "none", place}).code != 0)
        GTEST_SKIP() << "only root may mount a small disk";
    expect_recoverable_when_full("", folder);
    EXPECT_EQ(run_program("umount", {place}).code, 0);
}

/// A short whole trace for the rest.
class Damaged : public testing::Test {
  protected:
    void SetUp() override {
        write_file(folder_ / "drive.lua",
                   "return scenario 'drive' { town = 'town1', seed = 5, duration = 10,\n"
                   "run = function() spawn{ model = 'sedan', driver = 'autopilot' } wait(9) end }");
        const Result run = reprise({"run", "drive.lua", "-o", "a.mcap"}, folder_.path());
        ASSERT_EQ(run.code, 0) << run.out;
        whole_ = read_file(folder_ / "a.mcap");
    }

    Result recover(const std::string& bytes) {
        write_file(folder_ / "bad.mcap", bytes);
        return reprise({"recover", "bad.mcap", "-o", "out.mcap"}, folder_.path());
    }

    const Folder folder_;
    std::string whole_;
};

TEST_F(Damaged, TraceWithoutItsIndexLosesNothing) {
    const Result report = recover(whole_.substr(0, whole_.size() - 50));
    EXPECT_EQ(report.code, 0) << report.out;
    EXPECT_THAT(report.out, HasSubstr("  lost      nothing\n"));
    EXPECT_TRUE(read_file(folder_ / "out.mcap") == whole_);
}

TEST_F(Damaged, TraceKeepsTheTicksBeforeAFlippedBitAndSaysWhere) {
    std::string bytes = whole_;
    // Named in the index and, before that, behind the last chunk and its message indexes.
    const std::size_t outcome = bytes.rfind("reprise.outcome", bytes.rfind("reprise.outcome") - 1);
    const std::size_t at = outcome - 5000;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    const Result report = recover(bytes);
    EXPECT_EQ(report.code, 3) << report.out;
    EXPECT_THAT(report.out, HasSubstr("  why       byte "));
    EXPECT_THAT(report.out, HasSubstr("the chunk behind tick 128 is damaged"));
    EXPECT_EQ(reprise({"verify", folder_ / "out.mcap"}).code, 0);
    EXPECT_THAT(reprise({"info", folder_ / "out.mcap"}).out, HasSubstr("cut off"));
}

TEST_F(Damaged, TraceThatLostOnlyHowItEndedIsMadeWholeByARunOfIt) {
    write_file(folder_ / "short.lua",
               "return scenario 'short' { town = 'town1', seed = 5, duration = 3,\n"
               "run = function() spawn{ model = 'sedan', driver = 'autopilot' } wait(9) end }");
    ASSERT_EQ(reprise({"run", "short.lua", "-o", "s.mcap"}, folder_.path()).code, 0);
    // Of this level no tick tells how the run ended.
    const Result strip =
        reprise({"strip", "s.mcap", "--level", "inputs", "-o", "inputs.mcap"}, folder_.path());
    ASSERT_EQ(strip.code, 0) << strip.out;
    const std::string inputs = read_file(folder_ / "inputs.mcap");
    // In front of it everything else is whole; see above.
    const std::size_t outcome =
        inputs.rfind("reprise.outcome", inputs.rfind("reprise.outcome") - 1);
    const Result report = recover(inputs.substr(0, outcome));
    EXPECT_EQ(report.code, 3) << report.out;
    EXPECT_THAT(report.out, HasSubstr("60 ticks (3.00 s"));
    const Result verify = reprise({"verify", folder_ / "out.mcap"});
    EXPECT_EQ(verify.code, 1) << verify.out;
    EXPECT_THAT(verify.out, HasSubstr("all ticks are equal; nothing but how it ended was cut off"));
    const Result run = reprise({"run", "out.mcap", "-o", "again.mcap"}, folder_.path());
    EXPECT_EQ(run.code, 0) << run.out;
    EXPECT_TRUE(read_file(folder_ / "again.mcap") == read_file(folder_ / "s.mcap"));
}

TEST_F(Damaged, TraceOfWhichNothingIsLeftIsExitOneAndNoFile) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{9}, whole_.size() / 2}) {
        std::string bytes = whole_.substr(0, size);
        if (size > 1000)
            bytes[500] = static_cast<char>(bytes[500] ^ 1);
        const Result report = recover(bytes);
        EXPECT_EQ(report.code, 1) << size << report.out;
        EXPECT_THAT(report.out, HasSubstr("reprise: nothing can be recovered: bad.mcap: "));
        EXPECT_FALSE(fs::exists(folder_ / "out.mcap")) << size;
    }
}

TEST_F(Damaged, PathsThatCannotBeAreUsageErrorsAndChangeNothing) {
    const auto before = folder_.files();
    const std::vector<std::vector<std::string>> mistakes{
        {"recover", "a.mcap", "-o", "a.mcap"},
        {"recover", "a.mcap", "-o", "./a.mcap"},
        {"recover", "none.mcap", "-o", "b.mcap"},
        {"recover", "a.mcap", "-o", "nowhere/b.mcap"},
        {"recover", "a.mcap", "-o", "/proc/b.mcap"},
        {"recover", "a.mcap", "-o", "."},
        {"recover", "a.mcap"},
        {"recover", ".", "-o", "b.mcap"},
    };
    for (const auto& words : mistakes) {
        const Result report = reprise(words, folder_.path());
        EXPECT_EQ(report.code, 2) << report.out;
        EXPECT_EQ(std::count(report.out.begin(), report.out.end(), '\n'), 1) << report.out;
        EXPECT_EQ(folder_.files(), before);
        EXPECT_TRUE(read_file(folder_ / "a.mcap") == whole_);
    }
}

TEST_F(Damaged, TraceOnAFullDiskLeavesNothingHalfWritten) {
    write_file(folder_ / "cut.mcap", whole_.substr(0, whole_.size() - 50));
    const auto before = folder_.files();
    const Result report = typed("ulimit -f " + std::to_string(whole_.size() / 512) +
                                    "; reprise recover cut.mcap -o out.mcap",
                                folder_);
    EXPECT_EQ(report.code, 2) << report.out;
    EXPECT_THAT(report.out, HasSubstr("ulimit -f"));
    EXPECT_EQ(folder_.files(), before);
}

TEST_F(Damaged, TracePointsEveryOtherCommandToRecover) {
    write_file(folder_ / "cut.mcap", whole_.substr(0, whole_.size() - 50));
    const std::vector<std::vector<std::string>> commands{{"info", "cut.mcap"},
                                                         {"verify", "cut.mcap"},
                                                         {"diff", "a.mcap", "cut.mcap"},
                                                         {"diff", "cut.mcap", "a.mcap"},
                                                         {"render", "cut.mcap", "-o", "pictures"}};
    for (const auto& words : commands) {
        const Result report = reprise(words, folder_.path());
        EXPECT_EQ(report.code, 2) << report.out;
        EXPECT_THAT(report.out, HasSubstr("cut.mcap: "));
        EXPECT_THAT(report.out, HasSubstr("`reprise recover`"));
    }
}

}  // namespace
}  // namespace reprise::test
