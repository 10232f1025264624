#include "replay/recovery.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "replay/mcap/mcap.h"
#include "replay/trace_reader.h"
#include "tests/replay/synthetic_run.h"
#include "world/check.h"

namespace reprise::test {
namespace {

namespace mcap = replay::mcap;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t first_chunk = 64;  // ticks

class Recovery : public testing::Test {
  protected:
    void SetUp() override {
        write_trace(whole_path_, run_);
        whole_ = read_file(whole_path_);
        mcap::walk(mcap::View(whole_).subspan(8, whole_.size() - 16),
                   [&](const mcap::Record& record) {
                       if (record.op == mcap::Op::chunk)
                           last_chunk_ = record.at + 8;
                       if (record.op == mcap::Op::data_end)
                           data_end_ = record.at + 8;
                   });
    }

    /// Ticks that recovery brings back out of these bytes, all of them right; 0 when it refuses.
    std::uint64_t recovered(const Bytes& bytes) {
        write_file(damaged_path_, bytes);
        std::filesystem::remove(out_path_);
        try {
            recovery_ = replay::recover(damaged_path_, out_path_);
        } catch (const world::Error&) {
            EXPECT_FALSE(std::filesystem::exists(out_path_));
            return 0;
        }
        replay::TraceReader before(whole_path_);
        replay::TraceReader after(out_path_);
        EXPECT_FALSE(after.damage());
        for (std::uint64_t i = 1; i <= after.ticks(); ++i)
            EXPECT_EQ(bytes_of(after.tick(i)), bytes_of(before.tick(i))) << i;
        EXPECT_EQ(recovery_.outcome.ticks, after.ticks());
        return after.ticks();
    }

    Bytes cut(std::size_t size) const {
        return {whole_.begin(), whole_.begin() + static_cast<std::ptrdiff_t>(size)};
    }

    const SyntheticRun run_{.ticks = first_chunk + 2, .cars = 1};
    const Folder folder_;
    const std::filesystem::path whole_path_ = folder_ / "whole.mcap";
    const std::filesystem::path damaged_path_ = folder_ / "damaged.mcap";
    const std::filesystem::path out_path_ = folder_ / "out.mcap";
    Bytes whole_;
    std::size_t last_chunk_ = 0;  ///< offsets of the records in the file
    std::size_t data_end_ = 0;
    replay::Recovery recovery_;
};

TEST_F(Recovery, GivesTheSameFileWhenOnlyTheIndexIsMissing) {
    // Every 97th byte of the schemas in the index, then each one.
    for (std::size_t size = data_end_;
         size<whole_.size(); size += whole_.size() - size> 300 ? 97 : 1) {
        ASSERT_EQ(recovered(cut(size)), run_.ticks) << size;
        ASSERT_EQ(recovery_.loss, "") << size;
        ASSERT_TRUE(read_file(out_path_) == whole_) << size;
    }
}

TEST_F(Recovery, KeepsEveryWholeChunkWhereverTheLastOneIsCut) {
    // A chunk is whole once its record is; the indexes behind it can be made again.
    for (std::size_t size = last_chunk_; size < data_end_; ++size) {
        const std::uint64_t ticks = recovered(cut(size));
        ASSERT_TRUE(ticks == first_chunk || ticks == run_.ticks) << size;
        ASSERT_NE(recovery_.loss, "") << size;
        ASSERT_EQ(recovery_.outcome.verdict, "error") << size;
    }
}

/// The end of the file said it, and the ticks say it, too.
TEST_F(Recovery, TellsHowTheRunEndedWhenAllItsTicksAreThere) {
    const auto raise = [](world::TickDraft& draft, world::EventKind kind, const char* text) {
        draft.tick.events.emplace_back();
        draft.tick.events.back().kind = kind;
        draft.tick.events.back().text = text;
    };
    SyntheticRun run{.ticks = 70, .cars = 1};
    run.change = [&](world::TickDraft& draft) {
        if (draft.tick.index == 20)
            raise(draft, world::EventKind::check_failed, "slow");
        if (draft.tick.index == 70)
            raise(draft, world::EventKind::finished, "arrived");
    };
    write_trace(whole_path_, run);
    whole_ = read_file(whole_path_);
    const std::string outcome = "reprise.outcome";
    const auto end = std::search(whole_.begin(), whole_.end(), outcome.begin(), outcome.end());
    EXPECT_EQ(recovered({whole_.begin(), end}), 70U);
    EXPECT_EQ(recovery_.outcome, (world::Outcome{"failed", "arrived", 70}));
    EXPECT_EQ(replay::TraceReader(out_path_).outcome(), recovery_.outcome);
}

TEST_F(Recovery, RefusesWhatHasNoWholeChunkAndLeavesNoFile) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{8}, std::size_t{500}}) {
        EXPECT_EQ(recovered(cut(size)), 0U) << size;
    }
}

TEST_F(Recovery, OfFlippedBitsIsAlwaysRightOrRefused) {
    std::mt19937 random(20);
    std::uint64_t whole = 0;
    for (int i = 0; i < 2000; ++i) {
        Bytes bytes = whole_;
        bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
        if (recovered(bytes) == run_.ticks)
            ++whole;
    }
    EXPECT_GT(whole, 100U);  // such as flips in the indexes
}

TEST_F(Recovery, LeavesOutWhatLiesBehindADamagedChunkAndSaysSo) {
    Bytes bytes = whole_;
    bytes[last_chunk_ + 100] ^= 1;
    EXPECT_EQ(recovered(bytes), first_chunk);
    EXPECT_THAT(recovery_.loss, testing::HasSubstr("the chunk behind tick 64 is damaged"));
}

TEST_F(Recovery, RefusesAStartThatWasChangedAfterItWasRecorded) {
    // Another run's start, and this one's ticks: every checksum holds.
    SyntheticRun other = run_;
    other.seed = 8;
    write_trace(folder_ / "other.mcap", other);
    const Bytes theirs = read_file(folder_ / "other.mcap");
    const auto attachments = [](const Bytes& bytes) {
        std::pair<std::ptrdiff_t, std::ptrdiff_t> range{0, 0};
        mcap::walk(mcap::View(bytes).subspan(8, bytes.size() - 16),
                   [&](const mcap::Record& record) {
                       const auto at = static_cast<std::ptrdiff_t>(record.at + 8);
                       if (record.op == mcap::Op::attachment && range.first == 0)
                           range.first = at;
                       if (record.op == mcap::Op::chunk && range.second == 0)
                           range.second = at;
                   });
        return range;
    };
    const auto [from, to] = attachments(theirs);
    const auto [our_from, our_to] = attachments(whole_);
    Bytes spliced(whole_.begin(), whole_.begin() + our_from);
    spliced.insert(spliced.end(), theirs.begin() + from, theirs.begin() + to);
    spliced.insert(spliced.end(), whole_.begin() + our_to, whole_.end() - 50);
    EXPECT_EQ(recovered(spliced), 0U);
}

TEST_F(Recovery, StopsWhereAnotherRecordingsTicksBegin) {
    // The same ticks but for one value: every checksum holds, the chain does not.
    SyntheticRun other = run_;
    other.change = [](world::TickDraft& tick) {
        if (tick.tick.index == 60)
            tick.tick.digests.mutate_physics(12345);
    };
    write_trace(folder_ / "other.mcap", other);
    const Bytes theirs = read_file(folder_ / "other.mcap");
    std::size_t their_last = 0;
    mcap::walk(mcap::View(theirs).subspan(8, theirs.size() - 16), [&](const mcap::Record& record) {
        if (record.op == mcap::Op::chunk)
            their_last = record.at + 8;
    });
    Bytes spliced = cut(last_chunk_);
    spliced.insert(
        spliced.end(), theirs.begin() + static_cast<std::ptrdiff_t>(their_last), theirs.end());
    EXPECT_EQ(recovered(spliced), first_chunk);
    EXPECT_THAT(recovery_.loss, testing::HasSubstr("tick 65 does not continue the digest chain"));
}

}  // namespace
}  // namespace reprise::test
