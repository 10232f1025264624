#include "replay/trace_records.h"

#include <fmt/format.h>

#include "replay/trace_format.h"
#include "world/tick_bfbs_generated.h"
#include "world/traffic_bfbs_generated.h"

namespace reprise::replay {

std::vector<ChannelText> trace_channels(Level level) {
    const auto text = [](const std::uint8_t* data, std::size_t size) {
        return std::string(data, data + size);
    };
    using Tick = world::TickBinarySchema;
    using Traffic = world::TrafficBinarySchema;
    std::vector<ChannelText> channels{{"/sim/tick",
                                       "reprise.world.Tick",
                                       "flatbuffer",
                                       text(Tick::data(), Tick::size()),
                                       "flatbuffer"}};
    if (level == Level::full || level == Level::keyed)
        channels.push_back({"/sim/traffic",
                            "reprise.world.Traffic",
                            "flatbuffer",
                            text(Traffic::data(), Traffic::size()),
                            "flatbuffer"});
    return channels;
}

void PendingChunk::add(std::uint16_t channel,
                       std::uint64_t tick,
                       std::uint64_t log_time,
                       mcap::View data) {
    messages.push_back({channel, log_time, records.size()});
    mcap::Encoder record(records);
    record.number(static_cast<std::uint8_t>(mcap::Op::message));
    record.number(mcap::message_header + data.size());
    record.number(channel);
    record.number(static_cast<std::uint32_t>(tick));  // MCAP's sequence has 32 bits
    record.number(log_time);
    record.number(log_time);  // publish time
    record.raw(data);
}

TraceRecords::TraceRecords(RecordSink& sink, const std::vector<ChannelText>& channels)
    : sink_(sink) {
    put(mcap::magic);
    record_.clear();
    mcap::Encoder header(record_);
    header.begin(mcap::Op::header);
    header.text("");  // no profile
    // Not the program's version: equal runs of two builds would differ here, and nobody could tell
    // which of them is right.
    header.text(fmt::format("reprise/format {}", format::version));
    header.end();
    put(record_);
    for (std::size_t i = 0; i < channels.size(); ++i)
        describe(static_cast<std::uint16_t>(i + 1), channels[i]);
    put(schemas_);
    put(channels_);
}

/// A channel and its schema, which gets the same number.
void TraceRecords::describe(std::uint16_t id, const ChannelText& channel) {
    mcap::Encoder schema(schemas_);
    schema.begin(mcap::Op::schema);
    schema.number(id);
    schema.text(channel.schema);
    schema.text(channel.schema_encoding);
    schema.text(channel.schema_text);
    schema.end();
    mcap::Encoder record(channels_);
    record.begin(mcap::Op::channel);
    record.number(id);
    record.number(id);
    record.text(channel.topic);
    record.text(channel.message_encoding);
    record.texts({});
    record.end();
    messages_of_[id] = 0;
}

void TraceRecords::put(mcap::View bytes) {
    sink_.put(bytes);
    crc_ = mcap::crc32(bytes, crc_);
}

void TraceRecords::metadata(const std::string& name,
                            const std::map<std::string, std::string>& texts) {
    record_.clear();
    mcap::Encoder record(record_);
    record.begin(mcap::Op::metadata);
    record.text(name);
    record.texts(format::with_check(texts));
    record.end();
    metadata_.push_back({sink_.size(), record_.size(), name});
    put(record_);
}

void TraceRecords::attachment(const std::string& name,
                              const std::string& media_type,
                              mcap::View data) {
    record_.clear();
    mcap::Encoder record(record_);
    record.begin(mcap::Op::attachment);
    record.number(std::uint64_t{0});  // log time
    record.number(std::uint64_t{0});  // create time: no clock, equal runs give equal files
    record.text(name);
    record.text(media_type);
    record.number(std::uint64_t{data.size()});
    record.raw(data);
    record.number(mcap::crc32(mcap::View(record_).subspan(mcap::prefix_size)));
    record.end();
    attachments_.push_back({sink_.size(), record_.size(), data.size(), name, media_type});
    put(record_);
}

void TraceRecords::packed_attachment(const std::string& name, mcap::View data) {
    attachment(name, "application/zstd", sink_.pack(data));
}

void TraceRecords::chunk(const PendingChunk& pending) {
    if (pending.messages.empty())
        return;
    mcap::Chunk chunk;
    chunk.start_time = pending.messages.front().log_time;
    chunk.end_time = pending.messages.back().log_time;
    chunk.offset = sink_.size();
    chunk.compression = "zstd";
    chunk.uncompressed_size = pending.records.size();
    mcap::View data = sink_.pack(pending.records);
    if (data.size() >= pending.records.size()) {
        chunk.compression = "";
        data = pending.records;
    }
    chunk.compressed_size = data.size();
    chunk.length = mcap::chunk_header_size(chunk) + data.size();

    record_.clear();
    mcap::encode_chunk_header(record_, chunk, mcap::crc32(pending.records));
    put(record_);
    put(data);

    record_.clear();
    for (auto& [channel, total] : messages_of_) {
        mcap::MessageEntries entries;
        for (const PendingChunk::Message& message : pending.messages)
            if (message.channel == channel)
                entries.emplace_back(message.log_time, message.offset);
        if (entries.empty())
            continue;
        chunk.message_indexes.emplace_back(channel, sink_.size() + record_.size());
        mcap::encode_message_index(record_, channel, entries);
        total += entries.size();
    }
    chunk.message_index_length = record_.size();
    put(record_);
    chunks_.push_back(std::move(chunk));
    whole_ = sink_.size();
}

void TraceRecords::chunk_as_it_is(const mcap::Chunk& chunk,
                                  const std::map<std::uint16_t, std::uint64_t>& counts,
                                  mcap::View bytes) {
    for (const auto& [channel, count] : counts)
        messages_of_.at(channel) += count;
    chunks_.push_back(chunk);
    sink_.pass(bytes);
    crc_ = mcap::crc32(bytes, crc_);
    whole_ = sink_.size();
}

mcap::Statistics TraceRecords::statistics() const {
    mcap::Statistics statistics;
    statistics.schemas = static_cast<std::uint16_t>(messages_of_.size());  // one each
    statistics.channels = static_cast<std::uint32_t>(messages_of_.size());
    statistics.attachments = static_cast<std::uint32_t>(attachments_.size());
    statistics.metadata = static_cast<std::uint32_t>(metadata_.size());
    statistics.chunks = static_cast<std::uint32_t>(chunks_.size());
    if (!chunks_.empty()) {
        statistics.start_time = chunks_.front().start_time;
        statistics.end_time = chunks_.back().end_time;
    }
    for (const auto& [channel, count] : messages_of_) {
        if (count == 0)
            continue;
        statistics.messages += count;
        statistics.messages_of.emplace_back(channel, count);
    }
    return statistics;
}

mcap::Bytes TraceRecords::summary() const {
    const std::uint64_t start = sink_.size();
    mcap::Bytes bytes;
    mcap::Bytes offsets;
    const auto group = [&](mcap::Op op, const auto& encode) {
        const std::uint64_t from = bytes.size();
        encode();
        if (bytes.size() == from)
            return;
        mcap::Encoder record(offsets);
        record.begin(mcap::Op::summary_offset);
        record.number(static_cast<std::uint8_t>(op));
        record.number(start + from);
        record.number(std::uint64_t{bytes.size() - from});
        record.end();
    };
    const auto all = [&](const auto& entries) {
        return [&] {
            for (const auto& entry : entries)
                mcap::encode_index(bytes, entry);
        };
    };
    group(mcap::Op::schema, [&] { mcap::Encoder(bytes).raw(schemas_); });
    group(mcap::Op::channel, [&] { mcap::Encoder(bytes).raw(channels_); });
    group(mcap::Op::statistics, [&] { mcap::encode(bytes, statistics()); });
    group(mcap::Op::chunk_index, all(chunks_));
    group(mcap::Op::attachment_index, all(attachments_));
    group(mcap::Op::metadata_index, all(metadata_));

    const std::uint64_t offsets_start = start + bytes.size();
    mcap::Encoder record(bytes);
    record.raw(offsets);
    // The footer is covered by its own checksum up to it, length included.
    record.number(static_cast<std::uint8_t>(mcap::Op::footer));
    record.number(mcap::footer_size - mcap::prefix_size);
    record.number(start);
    record.number(offsets_start);
    record.number(mcap::crc32(bytes));
    record.raw(mcap::magic);
    return bytes;
}

void TraceRecords::finish() {
    record_.clear();
    mcap::Encoder record(record_);
    record.begin(mcap::Op::data_end);
    record.number(crc_);
    record.end();
    put(record_);
    put(summary());
}

}  // namespace reprise::replay
