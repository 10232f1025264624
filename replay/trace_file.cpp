#include "replay/trace_file.h"

#include <algorithm>

#include "replay/trace_format.h"
#include "world/fingerprint.h"
#include "world/tick_bfbs_generated.h"
#include "world/traffic_bfbs_generated.h"

namespace reprise::replay {

namespace {

/// The streams of a trace of this level, in the order of format::tick_channel and traffic_channel.
std::vector<TraceFile::Channel> trace_channels(Level level) {
    const auto text = [](const std::uint8_t* data, std::size_t size) {
        return std::string(data, data + size);
    };
    using Tick = world::TickBinarySchema;
    using Traffic = world::TrafficBinarySchema;
    std::vector<TraceFile::Channel> channels{{"/sim/tick",
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

}  // namespace

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

TraceFile::TraceFile(const std::filesystem::path& path, Level level)
    : TraceFile(path, trace_channels(level)) {}

TraceFile::TraceFile(const std::filesystem::path& path, const std::vector<Channel>& channels)
    : file_(path) {
    try {
        start(channels);
    } catch (...) {
        abandon();
        throw;
    }
}

void TraceFile::start(const std::vector<Channel>& channels) {
    put(mcap::magic);
    record_.clear();
    mcap::Encoder header(record_);
    header.begin(mcap::Op::header);
    header.text("");  // no profile
    header.text("reprise/" + world::build_fingerprint().front().second);
    header.end();
    put(record_);
    for (std::size_t i = 0; i < channels.size(); ++i)
        describe(static_cast<std::uint16_t>(i + 1), channels[i]);
    put(schemas_);
    put(channels_);
}

/// A channel and its schema, which gets the same number.
void TraceFile::describe(std::uint16_t id, const Channel& channel) {
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

void TraceFile::put(mcap::View bytes) {
    file_.append(bytes);
    crc_ = mcap::crc32(bytes, crc_);
}

void TraceFile::metadata(const std::string& name, const std::map<std::string, std::string>& texts) {
    record_.clear();
    mcap::Encoder record(record_);
    record.begin(mcap::Op::metadata);
    record.text(name);
    record.texts(format::with_check(texts));
    record.end();
    metadata_.push_back({file_.size(), record_.size(), name});
    put(record_);
}

void TraceFile::attachment(const std::string& name,
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
    attachments_.push_back({file_.size(), record_.size(), data.size(), name, media_type});
    put(record_);
}

void TraceFile::packed_attachment(const std::string& name, mcap::View data) {
    attachment(name, "application/zstd", compressor_.compress(data));
}

void TraceFile::chunk(const PendingChunk& pending) {
    if (pending.messages.empty())
        return;
    mcap::Chunk chunk;
    chunk.start_time = pending.messages.front().log_time;
    chunk.end_time = pending.messages.back().log_time;
    chunk.offset = file_.size();
    chunk.compression = "zstd";
    chunk.uncompressed_size = pending.records.size();
    mcap::View data = compressor_.compress(pending.records);
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
    mcap::Encoder record(record_);
    for (auto& [channel, total] : messages_of_) {
        const std::uint16_t number = channel;
        const auto of_channel = [&](const PendingChunk::Message& m) { return m.channel == number; };
        const auto count =
            std::count_if(pending.messages.begin(), pending.messages.end(), of_channel);
        if (count == 0)
            continue;
        chunk.message_indexes.emplace_back(number, file_.size() + record_.size());
        record.begin(mcap::Op::message_index);
        record.number(number);
        record.number(static_cast<std::uint32_t>(count * 16));
        for (const PendingChunk::Message& message : pending.messages) {
            if (!of_channel(message))
                continue;
            record.number(message.log_time);
            record.number(message.offset);
        }
        record.end();
        total += static_cast<std::uint64_t>(count);
    }
    chunk.message_index_length = record_.size();
    put(record_);
    chunks_.push_back(std::move(chunk));
    whole_ = file_.size();
}

mcap::Statistics TraceFile::statistics() const {
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

mcap::Bytes TraceFile::summary() const {
    const std::uint64_t start = file_.size();
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

void TraceFile::finish() {
    record_.clear();
    mcap::Encoder record(record_);
    record.begin(mcap::Op::data_end);
    record.number(crc_);
    record.end();
    put(record_);
    put(summary());
    file_.finish();
}

void TraceFile::abandon() noexcept {
    if (has_chunks())
        file_.keep(whole_);
    else
        file_.remove();
}

}  // namespace reprise::replay
