// Offsets beyond 32 bits, in a file that takes no room: the hole before its chunks is sparse.
#include <fstream>

#include <gmock/gmock.h>

#include "replay/mcap/mcap.h"
#include "replay/recovery.h"
#include "replay/trace_reader.h"
#include "tests/replay/synthetic_run.h"

namespace reprise::test {
namespace {

namespace mcap = replay::mcap;
using mcap::Bytes;
using mcap::View;

constexpr std::uint64_t hole = std::uint64_t{5} << 30;  ///< bytes, with the record's prefix
constexpr std::uint8_t private_record = 0x80;           ///< which readers skip

class BigTrace : public testing::Test {
  protected:
    void SetUp() override {
        write_trace(small_path_, {.ticks = 150});
        small_ = read_file(small_path_);
        mcap::walk(View(small_).subspan(8, small_.size() - 16), [&](const mcap::Record& record) {
            if (record.op == mcap::Op::chunk && first_chunk_ == 0)
                first_chunk_ = record.at + 8;
            if (record.op == mcap::Op::data_end)
                data_end_ = record.at + 8;
        });
        std::ofstream file(big_path_, std::ios::binary);
        write(file, View(small_).first(first_chunk_));
        Bytes prefix;
        mcap::Encoder encoder(prefix);
        encoder.number(private_record);
        encoder.number(hole - mcap::prefix_size);
        write(file, prefix);
        file.seekp(static_cast<std::streamoff>(first_chunk_ + hole));
        write(file, View(small_).subspan(first_chunk_, data_end_ - first_chunk_));
        if (with_index_)
            write(file, end());
    }

    static void write(std::ofstream& file, View bytes) {
        file.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }

    std::uint64_t moved(std::uint64_t offset) const {
        return offset < first_chunk_ ? offset : offset + hole;
    }

    /// The small trace's end, with what it points at moved.
    Bytes end() const {
        Bytes out(small_.begin() + static_cast<std::ptrdiff_t>(data_end_),
                  small_.begin() + static_cast<std::ptrdiff_t>(data_end_ + mcap::data_end_size));
        const std::uint64_t summary = data_end_ + mcap::data_end_size;
        mcap::Encoder encoder(out);
        const View records =
            View(small_).subspan(summary, small_.size() - summary - mcap::tail_size);
        mcap::walk(records, [&](const mcap::Record& record) { move(record, out); });
        encoder.number(static_cast<std::uint8_t>(mcap::Op::footer));
        encoder.number(mcap::footer_size - mcap::prefix_size);
        encoder.number(summary + hole);
        encoder.number(std::uint64_t{0});
        encoder.number(mcap::crc32(View(out).subspan(mcap::data_end_size)));
        encoder.raw(mcap::magic);
        return out;
    }

    void move(const mcap::Record& record, Bytes& out) const {
        if (record.op == mcap::Op::chunk_index) {
            mcap::Chunk chunk = mcap::decode_chunk_index(record.content);
            chunk.offset = moved(chunk.offset);
            for (auto& [channel, offset] : chunk.message_indexes)
                offset = moved(offset);
            mcap::encode_index(out, chunk);
        } else if (record.op == mcap::Op::metadata_index) {
            mcap::Metadata metadata = mcap::decode_metadata_index(record.content);
            metadata.offset = moved(metadata.offset);
            mcap::encode_index(out, metadata);
        } else if (record.op != mcap::Op::summary_offset) {
            mcap::Encoder encoder(out);
            encoder.begin(record.op);
            encoder.raw(record.content);
            encoder.end();
        }
    }

    bool with_index_ = true;
    const Folder folder_;
    const std::filesystem::path small_path_ = folder_ / "small.mcap";
    const std::filesystem::path big_path_ = folder_ / "big.mcap";
    Bytes small_;
    std::uint64_t first_chunk_ = 0;
    std::uint64_t data_end_ = 0;
};

TEST_F(BigTrace, GivesTicksFromBehindFiveGigabytes) {
    replay::TraceReader small(small_path_);
    replay::TraceReader big(big_path_);
    ASSERT_GT(big.file_size(), hole);
    ASSERT_EQ(big.ticks(), small.ticks());
    for (const std::uint64_t index : {150U, 1U, 65U, 64U, 128U})
        EXPECT_EQ(bytes_of(big.tick(index)), bytes_of(small.tick(index))) << index;
    EXPECT_EQ(big.outcome().verdict, "passed");
}

class BigPartial : public BigTrace {
  protected:
    BigPartial() { with_index_ = false; }
};

TEST_F(BigPartial, IsRecoveredWithoutReadingWhatItDoesNotNeed) {
    const replay::Recovery recovery = replay::recover(big_path_, folder_ / "out.mcap");
    EXPECT_EQ(recovery.loss, "");
    EXPECT_TRUE(read_file(folder_ / "out.mcap") == small_);
}

}  // namespace
}  // namespace reprise::test
