#include "replay/chunk_reader.h"

#include <algorithm>
#include <utility>

#include "replay/level.h"
#include "replay/trace_format.h"

namespace reprise::replay {

namespace {

/// The header is the index's twin: only the checksum is new in it. So the whole record is checked.
bool header_agrees(mcap::View header, const mcap::Chunk& chunk, std::uint32_t crc) {
    mcap::Bytes expected;
    mcap::encode_chunk_header(expected, chunk, crc);
    return std::equal(header.begin(), header.end(), expected.begin(), expected.end());
}

}  // namespace

bool ChunkReader::Messages::complete(Level level, std::uint64_t index) const {
    return !tick.empty() && (!traffic.empty() || !holds_traffic(level, index));
}

void ChunkReader::load(const InputFile& file,
                       const mcap::Chunk& chunk,
                       const TickRange& ticks,
                       std::uint64_t step_ns,
                       Level level) {
    damage_.reset();
    ticks_ = ticks;
    record_.resize(chunk.length);
    file.read(chunk.offset, record_);
    packed_ = mcap::View(record_).subspan(mcap::chunk_header_size(chunk));

    mcap::Decoder checksum(mcap::View(record_).subspan(mcap::chunk_crc_at));
    const auto crc = checksum.number<std::uint32_t>();
    unpack(chunk, crc);
    const mcap::View header = mcap::View(record_).first(mcap::chunk_header_size(chunk));
    if (!damage_ && !header_agrees(header, chunk, crc))
        damage_ = "its header differs from the index";
    find_messages(mcap::View(records_).first(usable_), step_ns, level);
    if (!damage_ && !message_indexes_agree(file, chunk))
        damage_ = "its message indexes differ from its messages";
}

/// What was found by a scan names no message indexes, and needs none.
bool ChunkReader::message_indexes_agree(const InputFile& file, const mcap::Chunk& chunk) {
    if (chunk.message_indexes.empty())
        return true;
    mcap::Bytes expected;
    mcap::encode_message_index(expected, format::tick_channel, tick_entries_);
    if (!traffic_entries_.empty())
        mcap::encode_message_index(expected, format::traffic_channel, traffic_entries_);
    const std::uint64_t at = chunk.offset + chunk.length;
    return chunk.message_index_length == expected.size() && expected.size() <= file.size() - at &&
           file.read(at, expected.size()) == expected;
}

void ChunkReader::unpack(const mcap::Chunk& chunk, std::uint32_t crc) {
    // Kept as large as the largest so far: clearing fresh memory would cost more than unpacking.
    if (records_.size() < chunk.uncompressed_size)
        records_.resize(chunk.uncompressed_size);
    const auto out = std::span(records_).first(chunk.uncompressed_size);
    usable_ = out.size();
    if (chunk.compression.empty()) {
        usable_ = std::min(out.size(), packed_.size());
        std::copy_n(packed_.begin(), usable_, out.begin());
        if (packed_.size() != out.size())
            damage_ = "its size differs";
    } else if (!decompressor_.decompress(packed_, out)) {
        damage_ = "it cannot be unpacked";
        usable_ = decompressor_.salvage(packed_, out);
    }
    if (!damage_ && mcap::crc32(out) != crc)
        damage_ = "its checksum differs";
}

void ChunkReader::find_messages(mcap::View records, std::uint64_t step_ns, Level level) {
    messages_.assign(ticks_.last - ticks_.first + 1, {});
    tick_entries_.clear();
    traffic_entries_.clear();
    std::uint64_t due_tick = ticks_.first;
    std::uint16_t due_channel = format::tick_channel;
    bool in_order = true;
    const auto keep = [&](const mcap::Record& record) {
        const bool was_in_order = std::exchange(in_order, false);
        if (record.op != mcap::Op::message)
            return;
        mcap::Decoder message(record.content);
        const auto channel = message.number<std::uint16_t>();
        const auto sequence = message.number<std::uint32_t>();
        const auto log_time = message.number<std::uint64_t>();
        const auto publish_time = message.number<std::uint64_t>();
        const std::uint64_t tick = log_time / step_ns;
        const bool ours = channel == format::tick_channel || channel == format::traffic_channel;
        if (!ours || log_time % step_ns != 0 || tick < ticks_.first || tick > ticks_.last ||
            sequence != static_cast<std::uint32_t>(tick))
            return;
        Messages& messages = messages_[tick - ticks_.first];
        (channel == format::tick_channel ? messages.tick : messages.traffic) = message.rest();
        if (tick != due_tick || channel != due_channel || publish_time != log_time)
            return;
        in_order = was_in_order;
        const bool traffic_is_due = channel == format::tick_channel && holds_traffic(level, tick);
        due_channel = traffic_is_due ? format::traffic_channel : format::tick_channel;
        due_tick += traffic_is_due ? 0 : 1;
        (channel == format::tick_channel ? tick_entries_ : traffic_entries_)
            .emplace_back(log_time, record.at);
    };
    try {
        mcap::walk(records, keep);
    } catch (const mcap::Malformed& error) {
        if (!damage_)
            damage_ = error.what();
    }
    std::uint64_t tick = ticks_.first;
    for (const Messages& messages : messages_)
        if (!messages.complete(level, tick++) && !damage_)
            damage_ = "it lacks a tick";
    if (!in_order && !damage_)
        damage_ = "it holds something else than the messages of its ticks";
}

}  // namespace reprise::replay
