// The file as MCAP's specification describes it, read by a walk of the test's own that shares no
// code with the room: records in order, and every checksum computed again, bit by bit.
#include <cstring>
#include <map>

#include <gmock/gmock.h>
#include <zstd.h>

#include "tests/replay/synthetic_run.h"

namespace reprise::test {

namespace {

using Bytes = std::vector<std::uint8_t>;

enum : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    attachment = 0x09,
    attachment_index = 0x0a,
    statistics = 0x0b,
    metadata = 0x0c,
    metadata_index = 0x0d,
    summary_offset = 0x0e,
    data_end = 0x0f
};

/// The definition of CRC-32/IEEE: one bit at a time.
std::uint32_t slow_crc(const std::uint8_t* bytes, std::size_t size) {
    std::uint32_t crc = 0xffffffffu;
    for (std::size_t i = 0; i < size; ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
    }
    return ~crc;
}

template <typename T>
T at(const Bytes& bytes, std::size_t offset) {
    T value{};
    if (offset + sizeof(T) > bytes.size())
        throw std::out_of_range("read behind the end");
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

struct Record {
    std::uint8_t op = 0;
    std::size_t offset = 0;  ///< of the prefix
    Bytes content;

    std::size_t length() const { return 9 + content.size(); }

    template <typename T>
    T get(std::size_t offset_in_content) const {
        return at<T>(content, offset_in_content);
    }

    std::string text(std::size_t offset_in_content) const {
        const auto size = get<std::uint32_t>(offset_in_content);
        const auto* from = reinterpret_cast<const char*>(content.data()) + offset_in_content + 4;
        return {from, from + size};
    }
};

std::vector<Record> records_of(const Bytes& bytes, std::size_t from, std::size_t to) {
    std::vector<Record> records;
    while (from < to) {
        const auto size = at<std::uint64_t>(bytes, from + 1);
        const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(from) + 9;
        records.push_back({bytes[from], from, {begin, begin + static_cast<std::ptrdiff_t>(size)}});
        from += 9 + size;
    }
    return records;
}

class McapLayout : public testing::Test {
  protected:
    void SetUp() override {
        const Folder folder;
        write_trace(folder / "run.mcap", {.ticks = 150, .cars = 20});
        bytes_ = read_file(folder / "run.mcap");
        records_ = records_of(bytes_, 8, bytes_.size() - 8);
    }

    std::vector<Record> all(std::uint8_t op) const {
        std::vector<Record> found;
        for (const Record& record : records_) {
            if (record.op == op)
                found.push_back(record);
        }
        return found;
    }

    const Record& record_at(std::size_t offset) const {
        for (const Record& record : records_) {
            if (record.offset == offset)
                return record;
        }
        throw std::out_of_range("no record begins there");
    }

    static Bytes unpacked(const Record& record) {
        Bytes out(record.get<std::uint64_t>(16));
        const std::size_t data = 28 + 4 + record.text(28).size() + 8;
        const std::size_t size = ZSTD_decompress(
            out.data(), out.size(), record.content.data() + data, record.content.size() - data);
        EXPECT_EQ(size, out.size());
        return out;
    }

    Bytes bytes_;
    std::vector<Record> records_;
};

TEST_F(McapLayout, HasItsRecordsInTheOrderThatTheSpecificationAsksFor) {
    std::vector<int> ops;
    for (const Record& record : records_)
        ops.push_back(record.op);
    const std::vector<int> expected{header,
                                    schema,
                                    schema,
                                    channel,
                                    channel,
                                    metadata,
                                    attachment,
                                    attachment,
                                    attachment,
                                    attachment,
                                    chunk,
                                    message_index,
                                    message_index,
                                    chunk,
                                    message_index,
                                    message_index,
                                    chunk,
                                    message_index,
                                    message_index,
                                    metadata,
                                    data_end,
                                    schema,
                                    schema,
                                    channel,
                                    channel,
                                    statistics,
                                    chunk_index,
                                    chunk_index,
                                    chunk_index,
                                    attachment_index,
                                    attachment_index,
                                    attachment_index,
                                    attachment_index,
                                    metadata_index,
                                    metadata_index,
                                    summary_offset,
                                    summary_offset,
                                    summary_offset,
                                    summary_offset,
                                    summary_offset,
                                    summary_offset,
                                    footer};
    EXPECT_EQ(ops, expected);
    const Bytes magic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
    EXPECT_TRUE(std::equal(magic.begin(), magic.end(), bytes_.begin()));
    EXPECT_TRUE(std::equal(magic.begin(), magic.end(), bytes_.end() - 8));
    EXPECT_EQ(all(header).front().text(0), "");
    EXPECT_THAT(all(header).front().text(4), testing::StartsWith("reprise/"));
}

TEST_F(McapLayout, HasChecksumsOfTheDataSectionAndTheSummary) {
    const Record end = all(data_end).front();
    EXPECT_EQ(end.get<std::uint32_t>(0), slow_crc(bytes_.data(), end.offset));
    const Record last = all(footer).front();
    const auto start = last.get<std::uint64_t>(0);
    EXPECT_EQ(start, end.offset + 13);
    EXPECT_EQ(last.get<std::uint32_t>(16),
              slow_crc(bytes_.data() + start, bytes_.size() - 8 - 4 - start));
    EXPECT_EQ(last.get<std::uint64_t>(8), all(summary_offset).front().offset);
}

TEST_F(McapLayout, HasChecksumsOfChunksAndAttachments) {
    for (const Record& record : all(chunk)) {
        const Bytes data = unpacked(record);
        EXPECT_EQ(record.get<std::uint32_t>(24), slow_crc(data.data(), data.size()));
    }
    for (const Record& record : all(attachment)) {
        const std::size_t checked = record.content.size() - 4;
        EXPECT_EQ(record.get<std::uint32_t>(checked), slow_crc(record.content.data(), checked));
    }
}

TEST_F(McapLayout, IndexesEveryMessageOfEveryChunk) {
    std::uint64_t tick = 0;
    for (const Record& index : all(chunk_index)) {
        const Record& record = record_at(index.get<std::uint64_t>(16));
        ASSERT_EQ(record.op, chunk);
        EXPECT_EQ(index.get<std::uint64_t>(24), record.length());
        EXPECT_EQ(index.get<std::uint64_t>(0), record.get<std::uint64_t>(0));
        EXPECT_EQ(index.get<std::uint64_t>(8), record.get<std::uint64_t>(8));
        const Bytes data = unpacked(record);
        const std::vector<Record> messages = records_of(data, 0, data.size());
        ASSERT_EQ(index.get<std::uint32_t>(32), 20u);  // two channels
        for (const std::size_t entry : {36u, 46u}) {
            const auto id = index.get<std::uint16_t>(entry);
            const Record& listed = record_at(index.get<std::uint64_t>(entry + 2));
            ASSERT_EQ(listed.op, message_index);
            EXPECT_EQ(listed.get<std::uint16_t>(0), id);
            std::size_t item = 6;
            for (const Record& one : messages) {
                if (one.get<std::uint16_t>(0) != id)
                    continue;
                EXPECT_EQ(listed.get<std::uint64_t>(item), one.get<std::uint64_t>(6));
                EXPECT_EQ(listed.get<std::uint64_t>(item + 8), one.offset);
                item += 16;
            }
            EXPECT_EQ(item, listed.content.size());
        }
        for (std::size_t i = 0; i < messages.size(); i += 2) {
            ++tick;
            for (const std::size_t side : {i, i + 1}) {
                EXPECT_EQ(messages[side].op, message);
                EXPECT_EQ(messages[side].get<std::uint16_t>(0), side - i + 1);
                EXPECT_EQ(messages[side].get<std::uint32_t>(2), tick);
                EXPECT_EQ(messages[side].get<std::uint64_t>(6), tick * 50'000'000);
                EXPECT_EQ(messages[side].get<std::uint64_t>(14), tick * 50'000'000);
            }
        }
    }
    EXPECT_EQ(tick, 150u);
}

TEST_F(McapLayout, IndexesAttachmentsMetadataAndGroups) {
    for (const auto& [index_op, op] :
         {std::pair{attachment_index, attachment}, std::pair{metadata_index, metadata}}) {
        for (const Record& index : all(index_op)) {
            const Record& record = record_at(index.get<std::uint64_t>(0));
            EXPECT_EQ(record.op, op);
            EXPECT_EQ(index.get<std::uint64_t>(8), record.length());
        }
    }
    for (const Record& group : all(summary_offset)) {
        const auto start = group.get<std::uint64_t>(1);
        const auto length = group.get<std::uint64_t>(9);
        for (const Record& record : records_of(bytes_, start, start + length))
            EXPECT_EQ(record.op, group.get<std::uint8_t>(0));
    }
    EXPECT_EQ(all(statistics).front().get<std::uint64_t>(0), 300u);
}

TEST_F(McapLayout, RepeatsSchemasAndChannelsInTheSummary) {
    for (const std::uint8_t op : {schema, channel}) {
        const std::vector<Record> records = all(op);
        ASSERT_EQ(records.size(), 4u);
        EXPECT_EQ(records[0].content, records[2].content);
        EXPECT_EQ(records[1].content, records[3].content);
    }
    EXPECT_EQ(all(schema)[0].text(2), "reprise.world.Tick");
    EXPECT_EQ(all(schema)[1].text(2), "reprise.world.Traffic");
    EXPECT_EQ(all(channel)[0].text(4), "/sim/tick");
    EXPECT_EQ(all(channel)[1].text(4), "/sim/traffic");
}

}  // namespace

}  // namespace reprise::test
