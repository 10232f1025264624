#include "replay/written_again.h"

#include <algorithm>

#include <fmt/format.h>

#include "replay/chain_seed.h"
#include "replay/level.h"
#include "replay/mcap/compression.h"
#include "replay/trace_facts.h"
#include "replay/trace_format.h"
#include "replay/trace_records.h"

namespace reprise::replay {

namespace {

/// The first byte that differs.
struct OtherByte {
    std::uint64_t at = 0;
};

/// Lies beside the file: what is put is compared with what is there.
class Beside : public RecordSink {
  public:
    explicit Beside(const OpenedTrace& trace) : trace_(trace) {}

    void put(mcap::View bytes) override {
        require_room(bytes.size());
        block_.resize(bytes.size());
        trace_.input.read(at_, block_);
        const auto other = std::mismatch(bytes.begin(), bytes.end(), block_.begin());
        if (other.first != bytes.end())
            throw OtherByte{at_ + static_cast<std::uint64_t>(other.first - bytes.begin())};
        at_ += bytes.size();
    }

    void pass(mcap::View bytes) override { at_ += bytes.size(); }

    std::uint64_t size() const override { return at_; }

    /// The file's own bytes, when they unpack to `data`.
    mcap::View pack(mcap::View data) override {
        const auto& all = trace_.index.attachments;
        const auto entry =
            std::ranges::find_if(all, [&](const auto& one) { return one.offset == at_; });
        if (entry == all.end())
            throw OtherByte{at_};
        constexpr std::uint64_t crc_size = 4;
        const std::uint64_t from = entry->offset + entry->length - crc_size - entry->data_size;
        packed_ = trace_.input.read(from, entry->data_size);
        unpacked_.resize(data.size());
        if (unpacked_size(packed_) != data.size() ||
            !decompressor_.decompress(packed_, unpacked_) || !std::ranges::equal(unpacked_, data))
            throw OtherByte{from};
        return packed_;
    }

    /// Bytes of the file that come next.
    mcap::View next(std::uint64_t size) {
        require_room(size);
        block_.resize(size);
        trace_.input.read(at_, block_);
        return block_;
    }

  private:
    void require_room(std::uint64_t size) const {
        if (size > trace_.input.size() - at_)
            throw OtherByte{trace_.input.size()};
    }

    const OpenedTrace& trace_;
    std::uint64_t at_ = 0;
    mcap::Bytes block_;
    mcap::Bytes packed_;
    mcap::Bytes unpacked_;
    Decompressor decompressor_;
};

/// A chunk as its place, its ticks and its sizes make it: nothing else is taken from the index.
mcap::Chunk written_chunk(const OpenedTrace& trace,
                          std::size_t i,
                          std::uint64_t offset,
                          std::map<std::uint16_t, std::uint64_t>& counts) {
    const mcap::Chunk& listed = trace.index.chunks[i];
    const TickRange& ticks = trace.ranges[i];
    mcap::Chunk chunk;
    chunk.start_time = ticks.first * trace.step_ns();
    chunk.end_time = ticks.last * trace.step_ns();
    chunk.offset = offset;
    chunk.compression = listed.compression;
    chunk.compressed_size = listed.compressed_size;
    chunk.uncompressed_size = listed.uncompressed_size;
    chunk.length = mcap::chunk_header_size(chunk) + chunk.compressed_size;
    counts[format::tick_channel] = ticks.last + 1 - ticks.first;
    if (const std::uint64_t with_traffic =
            traffic_ticks(trace.level, ticks.last) - traffic_ticks(trace.level, ticks.first - 1))
        counts[format::traffic_channel] = with_traffic;
    for (const auto& [channel, count] : counts) {
        chunk.message_indexes.emplace_back(channel,
                                           offset + chunk.length + chunk.message_index_length);
        chunk.message_index_length += mcap::message_index_size(count);
    }
    return chunk;
}

void write_chunk(const OpenedTrace& trace, std::size_t i, Beside& beside, TraceRecords& records) {
    std::map<std::uint16_t, std::uint64_t> counts;
    const mcap::Chunk chunk = written_chunk(trace, i, beside.size(), counts);
    if (chunk.offset != trace.index.chunks[i].offset ||
        chunk.length != trace.index.chunks[i].length)
        throw OtherByte{chunk.offset};
    const mcap::View bytes = beside.next(chunk.length + chunk.message_index_length);
    mcap::Decoder checksum(bytes.subspan(mcap::chunk_crc_at));
    mcap::Bytes header;
    mcap::encode_chunk_header(header, chunk, checksum.number<std::uint32_t>());
    const auto other = std::mismatch(header.begin(), header.end(), bytes.begin());
    if (other.first != header.end())
        throw OtherByte{chunk.offset + static_cast<std::uint64_t>(other.first - header.begin())};
    records.chunk_as_it_is(chunk, counts, bytes);
}

/// "in the attachment 'town.bin.zst'".
std::string place(const OpenedTrace& trace, std::uint64_t at) {
    const auto holds = [&](const auto& entry) {
        return at >= entry.offset && at - entry.offset < entry.length;
    };
    for (const mcap::Attachment& entry : trace.index.attachments)
        if (holds(entry))
            return fmt::format("in the attachment '{}'", entry.name);
    for (const mcap::Metadata& entry : trace.index.metadata)
        if (holds(entry))
            return fmt::format("in the metadata '{}'", entry.name);
    if (at >= trace.index.data_end)
        return "in the index";
    return trace.index.chunks.empty() || at < trace.index.chunks.front().offset
               ? "before the first tick"
               : "among the chunks";
}

void write_beside(const OpenedTrace& trace, const world::Digest128& last_chain, Beside& beside) {
    const world::EpisodeT& episode = trace.recording.episode;
    const mcap::Bytes packed_episode = format::pack(episode);
    TraceRecords records(beside, trace_channels(trace.level));
    records.metadata(
        format::run_metadata,
        run_facts(episode,
                  chain_seed(trace.recording),
                  trace.level,
                  trace.slice.run_ticks > 0 ? std::optional(trace.slice) : std::nullopt));
    write_attachments(records, trace.recording, packed_episode);
    for (std::size_t i = 0; i < trace.index.chunks.size(); ++i)
        write_chunk(trace, i, beside, records);
    records.metadata(format::outcome_metadata,
                     outcome_facts(trace.outcome, last_chain, packed_episode));
    records.finish();
    if (beside.size() != trace.input.size())
        throw OtherByte{beside.size()};
}

}  // namespace

std::optional<std::string> difference_from_written(const OpenedTrace& trace,
                                                   const world::Digest128& last_chain) {
    Beside beside(trace);
    try {
        write_beside(trace, last_chain, beside);
    } catch (const OtherByte& other) {
        return fmt::format("the file was changed after it was recorded (byte {}, {})",
                           other.at,
                           place(trace, other.at));
    }
    return std::nullopt;
}

}  // namespace reprise::replay
