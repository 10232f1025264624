#include "replay/trace_writer.h"

#include <csignal>
#include <sys/resource.h>

#include <gmock/gmock.h>

#include "replay/trace_reader.h"
#include "tests/replay/synthetic_run.h"
#include "world/check.h"

namespace reprise::test {

namespace {

using replay::TraceReader;
using replay::TraceWriter;
using testing::HasSubstr;
using testing::Not;

/// While it lives, no file of this process grows beyond `bytes`: the disk is full.
class SmallDisk {
  public:
    explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
    }

    ~SmallDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST(TraceWriter, WritesEqualFilesForEqualRuns) {
    const Folder folder;
    const SyntheticRun run{.ticks = 300, .cars = 100};
    write_trace(folder / "first.mcap", run);
    write_trace(folder / "second.mcap", run);
    EXPECT_EQ(read_file(folder / "first.mcap"), read_file(folder / "second.mcap"));
}

TEST(TraceWriter, GivesTheFileItsNameOnlyWhenItIsClosed) {
    const Folder folder;
    {
        TraceWriter writer(folder / "run.mcap", recording());
        for (const world::SealedTick& tick : drive({.ticks = 70}))
            writer.append(tick);
        EXPECT_FALSE(std::filesystem::exists(folder / "run.mcap"));
        writer.close({"completed", "", 70});
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "run.mcap"));
    EXPECT_FALSE(std::filesystem::exists(folder / "run.mcap.partial"));
}

TEST(TraceWriter, KeepsEveryTickOfARunThatStoppedEarlyInThePartialFile) {
    const Folder folder;
    const auto ticks = drive({.ticks = 70});
    {
        TraceWriter writer(folder / "run.mcap", recording());
        for (const world::SealedTick& tick : ticks)
            writer.append(tick);
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "run.mcap"));
    auto rest = TraceReader::salvage(folder / "run.mcap.partial");
    ASSERT_EQ(rest.ticks(), 70u);
    EXPECT_EQ(rest.outcome().verdict, "error");
    for (std::uint64_t index = 1; index <= 70; ++index)
        EXPECT_EQ(bytes_of(rest.tick(index)), bytes_of(ticks[index - 1]));
}

TEST(TraceWriter, LeavesNothingOfARunWithoutTicks) {
    const Folder folder;
    { const TraceWriter writer(folder / "run.mcap", recording()); }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(TraceWriter, LeavesTheOldTraceAloneUntilTheNewOneIsWhole) {
    const Folder folder;
    write_trace(folder / "run.mcap", {.ticks = 10});
    const auto before = read_file(folder / "run.mcap");
    {
        TraceWriter writer(folder / "run.mcap", recording());
        writer.append(drive({.ticks = 1}).front());
    }
    EXPECT_EQ(read_file(folder / "run.mcap"), before);
    write_trace(folder / "run.mcap", {.ticks = 20});
    EXPECT_EQ(TraceReader(folder / "run.mcap").ticks(), 20u);
}

TEST(TraceWriter, ReportsAFullDiskAndKeepsTheWholeChunks) {
    const Folder folder;
    const auto ticks = drive({.ticks = 2000, .cars = 50});
    std::string error;
    {
        const SmallDisk disk(200'000);
        TraceWriter writer(folder / "run.mcap", recording());
        error = error_of([&] {
            for (const world::SealedTick& tick : ticks)
                writer.append(tick);
            writer.close({"completed", "", 2000});
        });
    }
    EXPECT_THAT(error,
                HasSubstr("run.mcap: cannot write the trace: no file may be larger than 200.0 kB"));
    EXPECT_THAT(error, HasSubstr("run.mcap.partial"));
    EXPECT_FALSE(std::filesystem::exists(folder / "run.mcap"));
    auto rest = TraceReader::salvage(folder / "run.mcap.partial");
    EXPECT_GE(rest.ticks(), 64u);
    EXPECT_EQ(rest.ticks() % 64, 0u);
    EXPECT_EQ(bytes_of(rest.tick(rest.ticks())), bytes_of(ticks[rest.ticks() - 1]));
}

TEST(TraceWriter, LeavesNothingWhenTheDiskIsFullAtTheStart) {
    const Folder folder;
    std::string error;
    {
        const SmallDisk disk(1000);
        error = error_of([&] { const TraceWriter writer(folder / "run.mcap", recording()); });
    }
    EXPECT_THAT(error, HasSubstr("cannot write the trace"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(TraceWriter, LeavesNothingWhenTheDiskFillsUpBeforeTheFirstChunk) {
    const Folder folder;
    const auto ticks = drive({.ticks = 100, .cars = 50});
    std::string error;
    {
        const SmallDisk disk(40'000);
        error = error_of([&] {
            TraceWriter writer(folder / "run.mcap", recording());
            for (const world::SealedTick& tick : ticks)
                writer.append(tick);
            writer.close({"completed", "", 100});
        });
    }
    EXPECT_THAT(error, HasSubstr("(ulimit -f)"));
    EXPECT_THAT(error, Not(HasSubstr(".partial")));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(TraceWriter, RefusesPathsThatCannotBeWritten) {
    const Folder folder;
    const auto refusal = [&](const std::filesystem::path& path) {
        return error_of([&] { const TraceWriter writer(path, recording()); });
    };
    EXPECT_THAT(refusal(folder.path()), HasSubstr("this is a folder"));
    EXPECT_THAT(refusal(folder / "none/run.mcap"), HasSubstr("there is no folder"));
    EXPECT_THAT(refusal("/dev/null"), HasSubstr("not a plain file"));
    EXPECT_THAT(refusal("/proc/run.mcap"), HasSubstr("/proc/run.mcap: cannot write the trace"));
}

TEST(TraceWriter, RefusesAPathThatAnotherRunIsWriting) {
    const Folder folder;
    TraceWriter first(folder / "run.mcap", recording());
    const std::string error =
        error_of([&] { const TraceWriter second(folder / "run.mcap", recording()); });
    EXPECT_THAT(error, HasSubstr("another run is writing"));
    first.append(drive({.ticks = 1}).front());
    first.close({"completed", "", 1});
    EXPECT_EQ(TraceReader(folder / "run.mcap").ticks(), 1u);
}

TEST(TraceWriter, RefusesTicksOutOfOrder) {
    const Folder folder;
    const auto ticks = drive({.ticks = 2});
    TraceWriter writer(folder / "run.mcap", recording());
    EXPECT_THROW(writer.append(ticks[1]), world::CheckFailed);
}

}  // namespace

}  // namespace reprise::test
