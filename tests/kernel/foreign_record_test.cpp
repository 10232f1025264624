// Nothing in a trace may be changed with its checksums repaired and be called equal. Here: records
// that no run writes.
#include <gtest/gtest.h>

#include "replay/trace_facts.h"
#include "replay/trace_file.h"
#include "replay/trace_reader.h"
#include "tests/kernel/forged_trace.h"
#include "tests/replay/forgery.h"

namespace reprise::test {
namespace {

using replay::TraceReader;
namespace mcap = replay::mcap;
using Bytes = std::vector<std::uint8_t>;

/// Records that no run writes, each with a right index and right checksums.
class ForeignRecord : public ForgedTrace {
  protected:
    template <typename Extra>
    void write_with(Extra extra) {
        TraceReader trace(whole_);
        replay::TraceFile file(forged_, replay::Level::full, files::Unfinished::remove);
        replay::PendingChunk chunk;
        file.metadata(
            replay::format::run_metadata,
            replay::run_facts(trace.episode(), trace.chain(0), replay::Level::full, std::nullopt));
        const Bytes episode = replay::format::pack(trace.episode());
        write_attachments(file, trace.recording(), episode);
        for (std::uint64_t index = 1; index <= trace.ticks(); ++index) {
            const replay::RecordedTick tick = trace.tick(index);
            const std::uint64_t time = index * trace.episode().step_ns;
            chunk.add(replay::format::tick_channel, index, time, tick.tick_bytes);
            chunk.add(replay::format::traffic_channel, index, time, tick.traffic_bytes);
        }
        extra(file, chunk);
        file.chunk(chunk);
        file.metadata(replay::format::outcome_metadata,
                      replay::outcome_facts(trace.outcome(), trace.chain(trace.last()), episode));
        file.finish();
    }

    void expect_told() {
        EXPECT_NE(verified(forged_), "");
        EXPECT_NE(compared(whole_, forged_), "");
    }
};

TEST_F(ForeignRecord, IsToldWhereverItLies) {
    write_with([](auto&, auto&) {});
    ASSERT_EQ(read_file(forged_), read_file(whole_));
    write_with([](auto& file, auto&) { file.metadata("author", {{"name", "me"}}); });
    expect_told();
    write_with([](auto& file, auto&) {
        file.metadata(replay::format::run_metadata, {{"seed", "99"}});
    });
    expect_told();
    write_with([](auto& file, auto&) { file.attachment("note.txt", "text/plain", Bytes{1, 2}); });
    expect_told();
    write_with([](auto&, auto& chunk) { chunk.add(2, 6, 300'000'000, Bytes{1, 2, 3}); });
    expect_told();
    write_with([](auto&, auto& chunk) {
        mcap::Encoder record(chunk.records);  // of no channel: a private record
        record.number(std::uint8_t{0x80});
        record.number(std::uint64_t{0});
    });
    expect_told();
}

TEST_F(ForeignRecord, IsToldWhenTheIndexDoesNotKnowIt) {
    Bytes record;
    mcap::Encoder encoder(record);
    encoder.number(std::uint8_t{0x80});
    encoder.number(std::uint64_t{3});
    encoder.raw(Bytes{1, 2, 3});
    for (const bool in_summary : {false, true}) {
        Bytes bytes = read_file(whole_);
        insert_record(bytes, record, in_summary);
        write_file(forged_, bytes);
        expect_told();
    }
    Bytes bytes = read_file(whole_);
    bytes.insert(bytes.end() - mcap::tail_size, record.begin(), record.end());
    repair_checksums(bytes);
    write_file(forged_, bytes);
    expect_told();
}

}  // namespace
}  // namespace reprise::test
