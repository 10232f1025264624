#include "replay/trace_reader.h"

#include <algorithm>
#include <map>
#include <sys/stat.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "replay/chain_seed.h"
#include "replay/mcap/files.h"
#include "replay/trace_format.h"
#include "replay/trace_index.h"
#include "replay/trace_writer.h"
#include "tests/replay/synthetic_run.h"
#include "world/check.h"

namespace reprise::test {

namespace {

using replay::TraceReader;
using testing::HasSubstr;

TEST(TraceReader, GivesBackTheBytesThatWereWrittenInAnyOrder) {
    const Folder folder;
    const auto ticks = drive();
    write_trace(folder / "run.mcap");
    TraceReader trace(folder / "run.mcap");
    ASSERT_EQ(trace.ticks(), ticks.size());
    for (std::uint64_t index = 1; index <= ticks.size(); ++index)
        EXPECT_EQ(bytes_of(trace.tick(index)), bytes_of(ticks[index - 1]));
    for (const std::uint64_t index : {150u, 1u, 64u, 65u, 128u, 129u, 2u})
        EXPECT_EQ(bytes_of(trace.tick(index)), bytes_of(ticks[index - 1]));
}

/// The trace says that it is of this format; its own checksum over what it says is right.
void write_format(const std::filesystem::path& path, const std::string& other) {
    namespace format = replay::format;
    std::map<std::string, std::string> facts;
    {
        const replay::InputFile file(path);
        facts = *replay::read_metadata(file, *replay::read_index(file), format::run_metadata);
    }
    facts["format"] = other;
    std::vector<std::uint8_t> bytes = read_file(path);
    const auto put = [&](const std::string& key, const std::string& value) {
        const std::string name = format::run_metadata;
        const auto run = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
        const auto at = std::search(run, bytes.end(), key.begin(), key.end());
        ASSERT_NE(at, bytes.end());
        std::copy(value.begin(), value.end(), at + static_cast<std::ptrdiff_t>(key.size()) + 4);
    };
    put("format", facts["format"]);
    put("check", format::with_check(facts).at("check"));
    write_file(path, bytes);
}

TEST(TraceReader, RefusesATraceOfAnotherFormat) {
    const Folder folder;
    const auto path = folder / "run.mcap";
    for (const char* other : {"11", "99"}) {  // as long as ours, so that all else stays in place
        write_trace(path, {.ticks = 3});
        write_format(path, other);
        const std::string expected = fmt::format(
            "run.mcap: byte 0: a trace of format {}; this program reads format {}: "
            "record the run again, or use the program that recorded it",
            other,
            replay::format::version);
        EXPECT_THAT(error_of([&] { const TraceReader trace(path); }), HasSubstr(expected));
        EXPECT_THAT(error_of([&] { TraceReader::salvage(path); }), HasSubstr(expected));
    }
}

TEST(TraceReader, GivesBackWhatTheRunStartedFrom) {
    const Folder folder;
    write_trace(folder / "run.mcap");
    TraceReader trace(folder / "run.mcap");
    const world::Recording written = recording();
    EXPECT_EQ(trace.episode(), written.episode);
    EXPECT_EQ(trace.recording().town, written.town);
    EXPECT_EQ(trace.recording().network, written.network);
    EXPECT_EQ(trace.chain(0), replay::chain_seed(written));
    EXPECT_EQ(trace.chain(0), replay::chain_seed(trace.recording()));
}

TEST(TraceReader, GivesBackHowTheRunEnded) {
    const Folder folder;
    write_trace(folder / "run.mcap");
    const TraceReader trace(folder / "run.mcap");
    EXPECT_EQ(trace.outcome().verdict, "passed");
    EXPECT_EQ(trace.outcome().reason, "finished at line 2: arrived");
    EXPECT_EQ(trace.outcome().ticks, 150u);
}

TEST(TraceReader, CountsTheBytesOfAllMessages) {
    const Folder folder;
    std::uint64_t bytes = 0;
    for (const world::SealedTick& tick : drive())
        bytes += tick.tick_bytes().size() + tick.traffic_bytes().size();
    write_trace(folder / "run.mcap");
    const TraceReader trace(folder / "run.mcap");
    EXPECT_EQ(trace.message_bytes(), bytes);
    EXPECT_EQ(trace.file_size(), std::filesystem::file_size(folder / "run.mcap"));
}

TEST(TraceReader, OpensARunWithoutATick) {
    const Folder folder;
    write_trace(folder / "run.mcap", {.ticks = 0});
    TraceReader trace(folder / "run.mcap");
    EXPECT_EQ(trace.ticks(), 0u);
    EXPECT_EQ(trace.message_bytes(), 0u);
    EXPECT_EQ(trace.damage(), std::nullopt);
    EXPECT_EQ(trace.recording().town.name, "straight_road");
}

TEST(TraceReader, HoldsChunksOfAnyLength) {
    const Folder folder;
    for (const std::uint64_t count : {1u, 63u, 64u, 65u, 128u}) {
        write_trace(folder / "run.mcap", {.ticks = count});
        TraceReader trace(folder / "run.mcap");
        EXPECT_EQ(trace.ticks(), count);
        EXPECT_EQ(trace.tick(count).view.index(), count);
    }
}

TEST(TraceReader, GivesWhereChunksBeginAndEnd) {
    const Folder folder;
    write_trace(folder / "run.mcap");
    TraceReader trace(folder / "run.mcap");
    EXPECT_EQ(trace.packed(1).first, 1u);
    EXPECT_EQ(trace.packed(64).last, 64u);
    EXPECT_EQ(trace.packed(65).first, 65u);
    EXPECT_EQ(trace.packed(150).last, 150u);
}

TEST(TraceReader, RefusesATickThatIsNotThere) {
    const Folder folder;
    write_trace(folder / "run.mcap");
    TraceReader trace(folder / "run.mcap");
    EXPECT_THROW(trace.tick(0), world::CheckFailed);
    EXPECT_THROW(trace.tick(151), world::CheckFailed);
}

TEST(TraceReader, RefusesWhatIsNoTrace) {
    const Folder folder;
    const auto refusal = [](const std::filesystem::path& path) {
        return error_of([&] { const TraceReader trace(path); });
    };
    EXPECT_THAT(refusal(folder / "none.mcap"),
                HasSubstr("none.mcap: cannot open the trace: No such"));
    EXPECT_THAT(refusal(folder.path()), HasSubstr("not a trace: this is a folder"));
    write_file(folder / "empty.mcap", {});
    EXPECT_THAT(refusal(folder / "empty.mcap"), HasSubstr("not a trace: the file is empty"));
    write_file(folder / "text.mcap", std::vector<std::uint8_t>(1000, 'x'));
    EXPECT_THAT(refusal(folder / "text.mcap"), HasSubstr("byte 0: not a trace"));
    ASSERT_EQ(::mkfifo((folder / "pipe.mcap").c_str(), 0600), 0);
    EXPECT_THAT(refusal(folder / "pipe.mcap"), HasSubstr("not a plain file"));
}

}  // namespace

}  // namespace reprise::test
