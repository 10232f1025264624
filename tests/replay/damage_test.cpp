// Truncated, flipped and forged traces: always an error or a detected damage, never a wrong tick.
#include <cstring>
#include <random>

#include <gmock/gmock.h>

#include "replay/mcap/mcap.h"
#include "replay/trace_reader.h"
#include "tests/replay/synthetic_run.h"
#include "world/check.h"

namespace reprise::test {

namespace {

using replay::TraceReader;
using testing::HasSubstr;
namespace mcap = replay::mcap;
using Bytes = std::vector<std::uint8_t>;

class DamagedTrace : public testing::Test {
  protected:
    void SetUp() override {
        write_trace(path_, run_);
        whole_ = read_file(path_);
        for (const world::SealedTick& tick : drive(run_))
            ticks_.push_back(bytes_of(tick));
    }

    /// What opening the trace with these bytes throws.
    std::string opening(const Bytes& bytes) {
        write_file(path_, bytes);
        return error_of([&] { const TraceReader trace(path_); });
    }

    /// Reads all that can be read. True when something was found to be damaged; wrong ticks fail
    /// the test, and so does any exception but world::Error.
    bool detected(const Bytes& bytes) {
        write_file(path_, bytes);
        bool found = false;
        try {
            TraceReader trace(path_);
            found = trace.damage().has_value();
            for (std::uint64_t index = 1; index <= trace.ticks(); ++index) {
                if (trace.damage(index)) {
                    found = true;
                    if (const auto tick = trace.salvaged(index)) {
                        EXPECT_EQ(tick->view.index(), index);  // its values may be wrong
                    }
                    continue;
                }
                EXPECT_LE(index, ticks_.size());
                EXPECT_EQ(bytes_of(trace.tick(index)), ticks_.at(index - 1)) << index;
            }
            EXPECT_EQ(trace.ticks(), ticks_.size());
            trace.recording();
        } catch (const world::Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(path_.string()));
            found = true;
        }
        return found;
    }

    /// Position and size of a record's prefix, found by walking the data section.
    std::vector<std::pair<std::size_t, std::size_t>> records(mcap::Op op) const {
        std::vector<std::pair<std::size_t, std::size_t>> found;
        mcap::walk(
            mcap::View(whole_).subspan(8, whole_.size() - 16), [&](const mcap::Record& record) {
                if (record.op == op)
                    found.emplace_back(record.at + 8, record.content.size() + mcap::prefix_size);
            });
        return found;
    }

    /// The summary's checksum made right again: a forger's work.
    static void forge_summary_crc(Bytes& bytes) {
        std::uint64_t start = 0;
        std::memcpy(&start, bytes.data() + bytes.size() - mcap::tail_size + 9, sizeof(start));
        if (start > bytes.size() - mcap::tail_size)
            return;
        const std::uint32_t crc =
            mcap::crc32(mcap::View(bytes).subspan(start, bytes.size() - 12 - start));
        std::memcpy(bytes.data() + bytes.size() - 12, &crc, sizeof(crc));
    }

    const SyntheticRun run_{.ticks = 150, .cars = 20};
    Folder folder_;
    std::filesystem::path path_ = folder_ / "run.mcap";
    Bytes whole_;
    std::vector<TickBytes> ticks_;
};

TEST_F(DamagedTrace, IsReportedWhenItEndsAnywhereInItsLastTwoThousandBytes) {
    for (std::size_t cut = 1; cut <= 2000; ++cut) {
        const Bytes bytes(whole_.begin(), whole_.end() - static_cast<std::ptrdiff_t>(cut));
        const std::string error = opening(bytes);
        ASSERT_THAT(error, HasSubstr("cut off after tick 150")) << cut;
    }
}

TEST_F(DamagedTrace, IsReportedWithItsWholeTicksWhereverItEnds) {
    const auto chunks = records(mcap::Op::chunk);
    ASSERT_EQ(chunks.size(), 3u);
    for (std::size_t size = 0; size < whole_.size(); size += 97) {
        const std::string error =
            opening({whole_.begin(), whole_.begin() + static_cast<std::ptrdiff_t>(size)});
        const auto behind = [&](std::size_t i) { return chunks[i].first + chunks[i].second; };
        if (size >= behind(2))
            EXPECT_THAT(error, HasSubstr("cut off after tick 150")) << size;
        else if (size >= behind(1))
            EXPECT_THAT(error, HasSubstr("cut off after tick 128")) << size;
        else if (size >= behind(0))
            EXPECT_THAT(error, HasSubstr("cut off after tick 64")) << size;
        else
            EXPECT_NE(error, "") << size;
    }
}

TEST_F(DamagedTrace, GivesTheTicksOfItsWholeChunksWhenOpenedAsPartial) {
    const auto chunks = records(mcap::Op::chunk);
    write_file(
        path_,
        {whole_.begin(), whole_.begin() + static_cast<std::ptrdiff_t>(chunks[2].first + 99)});
    auto trace = TraceReader::salvage(path_);
    ASSERT_EQ(trace.ticks(), 128u);
    for (std::uint64_t index = 1; index <= 128; ++index)
        EXPECT_EQ(bytes_of(trace.tick(index)), ticks_[index - 1]);
    EXPECT_EQ(trace.recording().town.name, "straight_road");
    EXPECT_THAT(trace.damage().value_or(""), HasSubstr("cut off after tick 128"));
}

TEST_F(DamagedTrace, NeverGivesAWrongTickForOneFlippedBit) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 500; ++i) {
        Bytes bytes = whole_;
        const std::size_t bit = random() % (bytes.size() * 8);
        bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << (bit % 8)));
        EXPECT_TRUE(detected(bytes)) << "bit " << bit;
    }
}

TEST_F(DamagedTrace, NamesTheTicksOfAChunkWithOneFlippedBit) {
    std::mt19937_64 random(4);
    const auto [from, size] = records(mcap::Op::chunk)[1];
    for (int i = 0; i < 200; ++i) {
        Bytes bytes = whole_;
        const std::size_t bit = (from + 9) * 8 + random() % ((size - 9) * 8);
        bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << (bit % 8)));
        write_file(path_, bytes);
        TraceReader trace(path_);
        for (const std::uint64_t index : {1u, 64u, 129u, 150u})
            EXPECT_EQ(bytes_of(trace.tick(index)), ticks_[index - 1]);
        EXPECT_EQ(trace.damage(64), std::nullopt);
        EXPECT_EQ(trace.damage(129), std::nullopt);
        EXPECT_THAT(trace.damage(65).value_or(""), HasSubstr("ticks 65 to 128"));
        EXPECT_THAT(error_of([&] { trace.tick(65); }),
                    HasSubstr("run.mcap: byte " + std::to_string(from) + ": "));
    }
}

TEST_F(DamagedTrace, GivesWhatCanBeSalvagedOfADamagedChunk) {
    const auto [from, size] = records(mcap::Op::chunk)[1];
    Bytes bytes = whole_;
    bytes[from + 24 + 9] ^= 1;  // only the checksum: every tick is still there
    write_file(path_, bytes);
    TraceReader intact(path_);
    ASSERT_TRUE(intact.damage(65));
    for (std::uint64_t index = 65; index <= 128; ++index) {
        const auto tick = intact.salvaged(index);
        ASSERT_TRUE(tick);
        EXPECT_EQ(bytes_of(*tick), ticks_[index - 1]);
    }
    // From the middle of the packed bytes on nothing makes sense.
    bytes = whole_;
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(from + size / 2), size / 4, 0);
    write_file(path_, bytes);
    TraceReader broken(path_);
    std::uint64_t had = 0;
    for (std::uint64_t index = 65; index <= 128; ++index) {
        const auto tick = broken.salvaged(index);
        had += tick && bytes_of(*tick) == ticks_[index - 1] ? 1u : 0u;
    }
    EXPECT_LT(had, 64u);
    EXPECT_TRUE(broken.damage(128));
}

TEST_F(DamagedTrace, NamesTheDamagedAttachment) {
    for (const auto& [from, size] : records(mcap::Op::attachment)) {
        Bytes bytes = whole_;
        bytes[from + size - 10] ^= 4;
        const std::string name(whole_.begin() + static_cast<std::ptrdiff_t>(from + 9 + 16 + 4),
                               whole_.begin() + static_cast<std::ptrdiff_t>(from + 9 + 16 + 14));
        write_file(path_, bytes);
        const std::string error = error_of([&] {
            TraceReader trace(path_);
            trace.recording();
            if (const auto damage = trace.damage())
                throw world::Error(*damage);
        });
        if (name == "scenario/m")  // a copy for people; the episode holds the one that counts
            EXPECT_THAT(error, HasSubstr("in the attachment 'scenario/main.lua'"));
        else
            EXPECT_THAT(error, HasSubstr("the attachment '" + name.substr(0, 8)));
    }
}

TEST_F(DamagedTrace, IsReportedForEveryBitOfAChunksHeader) {
    const auto [from, size] = records(mcap::Op::chunk)[1];
    for (std::size_t bit = from * 8; bit < (from + 9 + 8 * 3 + 4 + 4 + 4 + 8) * 8; ++bit) {
        Bytes bytes = whole_;
        bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << (bit % 8)));
        write_file(path_, bytes);
        TraceReader trace(path_);
        EXPECT_TRUE(trace.damage(65)) << bit - from * 8;
        EXPECT_FALSE(trace.damage(1));
    }
}

TEST_F(DamagedTrace, IsReportedForEveryBitOfItsMetadata) {
    for (const auto& [from, size] : records(mcap::Op::metadata)) {
        for (std::size_t at = from; at < from + size; ++at) {
            Bytes bytes = whole_;
            bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1u << (at % 8)));
            EXPECT_THAT(opening(bytes), HasSubstr("the metadata 'reprise.")) << at - from;
        }
    }
}

TEST_F(DamagedTrace, IsReportedWhenItsIndexIsOutOfOrder) {
    const auto indexes = records(mcap::Op::chunk_index);
    const auto times = [&](std::size_t i) {
        return whole_.begin() + static_cast<std::ptrdiff_t>(indexes[i].first + 9);
    };
    Bytes bytes = whole_;
    std::copy_n(times(1), 16, bytes.begin() + (times(0) - whole_.begin()));
    std::copy_n(times(0), 16, bytes.begin() + (times(1) - whole_.begin()));
    forge_summary_crc(bytes);
    EXPECT_THAT(opening(bytes), HasSubstr("the index is damaged: after tick 0 comes a chunk"));
}

TEST_F(DamagedTrace, PlaysThoughItsTownIsDamaged) {
    const auto [from, size] = records(mcap::Op::attachment)[2];
    Bytes bytes = whole_;
    bytes[from + size - 10] ^= 4;
    write_file(path_, bytes);
    TraceReader trace(path_);
    EXPECT_EQ(bytes_of(trace.tick(70)), ticks_[69]);
    EXPECT_THAT(error_of([&] { trace.recording(); }), HasSubstr("'town.bin.zst' is damaged"));
}

TEST_F(DamagedTrace, IsReportedForEveryForgedIndex) {
    std::mt19937_64 random(5);
    int found = 0;
    int forged = 0;
    const std::size_t index = records(mcap::Op::chunk_index).front().first;
    for (int i = 0; i < 1000; ++i) {
        Bytes bytes = whole_;
        const std::size_t at = index + random() % (bytes.size() - index - 12);
        constexpr std::uint64_t telling[] = {0, 1, 8, 0x7f, 0xff, 0xffffffff, ~std::uint64_t{0}};
        const std::uint64_t value = i % 2 == 0 ? telling[random() % 7] : random();
        const std::size_t width = std::size_t{1} << random() % 4;
        std::memcpy(bytes.data() + at, &value, std::min(width, bytes.size() - 12 - at));
        forge_summary_crc(bytes);
        forged += bytes != whole_ ? 1 : 0;
        found += detected(bytes) ? 1 : 0;
    }
    EXPECT_EQ(found, forged);
}

}  // namespace

}  // namespace reprise::test
