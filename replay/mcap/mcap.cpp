#include "replay/mcap/mcap.h"

#include <zlib.h>

namespace reprise::replay::mcap {

namespace {

/// map<u16, u64>: byte length, then pairs.
void encode_pairs(Encoder& record,
                  const std::vector<std::pair<std::uint16_t, std::uint64_t>>& pairs) {
    record.number(static_cast<std::uint32_t>(pairs.size() * 10));
    for (const auto& [key, value] : pairs) {
        record.number(key);
        record.number(value);
    }
}

std::vector<std::pair<std::uint16_t, std::uint64_t>> decode_pairs(Decoder& record) {
    Decoder pairs(record.raw(record.number<std::uint32_t>()));
    std::vector<std::pair<std::uint16_t, std::uint64_t>> result;
    while (!pairs.rest().empty()) {
        const auto key = pairs.number<std::uint16_t>();
        result.emplace_back(key, pairs.number<std::uint64_t>());
    }
    return result;
}

}  // namespace

std::uint32_t crc32(View bytes, std::uint32_t before) {
    return static_cast<std::uint32_t>(::crc32_z(before, bytes.data(), bytes.size()));
}

void Encoder::begin(Op op) {
    number(static_cast<std::uint8_t>(op));
    length_at_ = out_->size();
    number(std::uint64_t{0});
}

void Encoder::end() {
    const std::uint64_t length = out_->size() - length_at_ - sizeof(std::uint64_t);
    std::memcpy(out_->data() + length_at_, &length, sizeof(length));
}

void Encoder::text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    raw({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void Encoder::texts(const std::map<std::string, std::string>& texts) {
    std::size_t size = 0;
    for (const auto& [key, value] : texts)
        size += 8 + key.size() + value.size();
    number(static_cast<std::uint32_t>(size));
    for (const auto& [key, value] : texts) {
        text(key);
        text(value);
    }
}

View Decoder::raw(std::uint64_t size) {
    if (size > left_.size())
        throw Malformed("a record is longer than what holds it");
    const View bytes = left_.first(size);
    left_ = left_.subspan(size);
    return bytes;
}

std::string Decoder::text() {
    const View bytes = raw(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::map<std::string, std::string> Decoder::texts() {
    Decoder pairs(raw(number<std::uint32_t>()));
    std::map<std::string, std::string> result;
    while (!pairs.rest().empty()) {
        std::string key = pairs.text();
        result[std::move(key)] = pairs.text();
    }
    return result;
}

std::uint64_t chunk_header_size(const Chunk& chunk) {
    return chunk_crc_at + 4 + 4 + chunk.compression.size() + 8;
}

void encode_chunk_header(Bytes& out, const Chunk& chunk, std::uint32_t uncompressed_crc) {
    Encoder record(out);
    // The length includes the compressed bytes, which the caller writes behind this.
    record.number(static_cast<std::uint8_t>(Op::chunk));
    record.number(chunk_header_size(chunk) - prefix_size + chunk.compressed_size);
    record.number(chunk.start_time);
    record.number(chunk.end_time);
    record.number(chunk.uncompressed_size);
    record.number(uncompressed_crc);
    record.text(chunk.compression);
    record.number(chunk.compressed_size);
}

void encode_message_index(Bytes& out, std::uint16_t channel, const MessageEntries& entries) {
    Encoder record(out);
    record.begin(Op::message_index);
    record.number(channel);
    record.number(static_cast<std::uint32_t>(entries.size() * 16));
    for (const auto& [log_time, offset] : entries) {
        record.number(log_time);
        record.number(offset);
    }
    record.end();
}

void encode_index(Bytes& out, const Chunk& chunk) {
    Encoder record(out);
    record.begin(Op::chunk_index);
    record.number(chunk.start_time);
    record.number(chunk.end_time);
    record.number(chunk.offset);
    record.number(chunk.length);
    encode_pairs(record, chunk.message_indexes);
    record.number(chunk.message_index_length);
    record.text(chunk.compression);
    record.number(chunk.compressed_size);
    record.number(chunk.uncompressed_size);
    record.end();
}

void encode_index(Bytes& out, const Attachment& attachment) {
    Encoder record(out);
    record.begin(Op::attachment_index);
    record.number(attachment.offset);
    record.number(attachment.length);
    record.number(std::uint64_t{0});  // log time
    record.number(std::uint64_t{0});  // create time
    record.number(attachment.data_size);
    record.text(attachment.name);
    record.text(attachment.media_type);
    record.end();
}

void encode_index(Bytes& out, const Metadata& metadata) {
    Encoder record(out);
    record.begin(Op::metadata_index);
    record.number(metadata.offset);
    record.number(metadata.length);
    record.text(metadata.name);
    record.end();
}

void encode(Bytes& out, const Statistics& statistics) {
    Encoder record(out);
    record.begin(Op::statistics);
    record.number(statistics.messages);
    record.number(statistics.schemas);
    record.number(statistics.channels);
    record.number(statistics.attachments);
    record.number(statistics.metadata);
    record.number(statistics.chunks);
    record.number(statistics.start_time);
    record.number(statistics.end_time);
    encode_pairs(record, statistics.messages_of);
    record.end();
}

Chunk decode_chunk_index(View content) {
    Decoder record(content);
    Chunk chunk;
    chunk.start_time = record.number<std::uint64_t>();
    chunk.end_time = record.number<std::uint64_t>();
    chunk.offset = record.number<std::uint64_t>();
    chunk.length = record.number<std::uint64_t>();
    chunk.message_indexes = decode_pairs(record);
    chunk.message_index_length = record.number<std::uint64_t>();
    chunk.compression = record.text();
    chunk.compressed_size = record.number<std::uint64_t>();
    chunk.uncompressed_size = record.number<std::uint64_t>();
    return chunk;
}

Attachment decode_attachment_index(View content) {
    Decoder record(content);
    Attachment attachment;
    attachment.offset = record.number<std::uint64_t>();
    attachment.length = record.number<std::uint64_t>();
    record.raw(16);  // log and create time
    attachment.data_size = record.number<std::uint64_t>();
    attachment.name = record.text();
    attachment.media_type = record.text();
    return attachment;
}

Metadata decode_metadata_index(View content) {
    Decoder record(content);
    Metadata metadata;
    metadata.offset = record.number<std::uint64_t>();
    metadata.length = record.number<std::uint64_t>();
    metadata.name = record.text();
    return metadata;
}

Statistics decode_statistics(View content) {
    Decoder record(content);
    Statistics statistics;
    statistics.messages = record.number<std::uint64_t>();
    statistics.schemas = record.number<std::uint16_t>();
    statistics.channels = record.number<std::uint32_t>();
    statistics.attachments = record.number<std::uint32_t>();
    statistics.metadata = record.number<std::uint32_t>();
    statistics.chunks = record.number<std::uint32_t>();
    statistics.start_time = record.number<std::uint64_t>();
    statistics.end_time = record.number<std::uint64_t>();
    statistics.messages_of = decode_pairs(record);
    return statistics;
}

Footer decode_footer(View content) {
    Decoder record(content);
    Footer footer;
    footer.summary_start = record.number<std::uint64_t>();
    footer.summary_offset_start = record.number<std::uint64_t>();
    footer.summary_crc = record.number<std::uint32_t>();
    return footer;
}

}  // namespace reprise::replay::mcap
