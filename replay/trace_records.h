// Private to the room, and to others' formats in MCAP through TraceFile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "replay/mcap/mcap.h"
#include "replay/recorded_tick.h"
#include "replay/trace_format.h"
#include "world/recording.h"

namespace reprise::replay {

/// The message records of some ticks, on their way into one chunk.
struct PendingChunk {
    struct Message {
        std::uint16_t channel;
        std::uint64_t log_time;
        std::uint64_t offset;  ///< of the record in `records`
    };

    /// Room for 250 cars: where memory is handed out in huge pages, to double it in the middle of
    /// a drive may take 5 ms.
    static constexpr std::size_t usual_size = std::size_t{2} << 20U;  // [bytes]

    mcap::Bytes records;
    std::vector<Message> messages;

    PendingChunk() { records.reserve(usual_size); }

    void add(std::uint16_t channel, std::uint64_t tick, std::uint64_t log_time, mcap::View data);

    void clear() {
        records.clear();
        messages.clear();
    }
};

/// Where records go, one behind another: into a file, or beside one that is there, to compare.
class RecordSink {
  public:
    virtual ~RecordSink() = default;

    virtual void put(mcap::View bytes) = 0;

    /// The same for bytes that were compared already.
    virtual void pass(mcap::View bytes) { put(bytes); }

    /// Of all that was put.
    virtual std::uint64_t size() const = 0;

    /// What is stored of `data`, a zstd frame. Borrowed until the next call.
    virtual mcap::View pack(mcap::View data) = 0;
};

/// A stream of messages, and the schema that describes them.
struct ChannelText {
    std::string topic;
    std::string schema;
    std::string schema_encoding;
    std::string schema_text;
    std::string message_encoding;
};

/// The streams of a trace of this level, in the order of format::tick_channel and traffic_channel.
std::vector<ChannelText> trace_channels(Level level);

/// The records of a trace in their order, and the only place that knows how they look: what is
/// written by it is compared by it. Keeps what the index at the end needs, about 150 bytes a chunk.
class TraceRecords {
  public:
    /// Puts magic, header, schemas and channels, which are numbered from 1.
    TraceRecords(RecordSink& sink, const std::vector<ChannelText>& channels);

    void metadata(const std::string& name, const std::map<std::string, std::string>& texts);
    void attachment(const std::string& name, const std::string& media_type, mcap::View data);
    void packed_attachment(const std::string& name, mcap::View data);

    /// Packs; the message indexes follow. Nothing for an empty chunk.
    void chunk(const PendingChunk& chunk);

    /// The same for a chunk that is written already: `bytes` are its record and its message
    /// indexes, `counts` the messages of each channel that has some.
    void chunk_as_it_is(const mcap::Chunk& chunk,
                        const std::map<std::uint16_t, std::uint64_t>& counts,
                        mcap::View bytes);

    /// Data end, summary, footer, magic.
    void finish();

    bool has_chunks() const { return !chunks_.empty(); }

    /// Where the last whole chunk ends; 0 without one.
    std::uint64_t whole() const { return whole_; }

  private:
    void put(mcap::View bytes);
    void describe(std::uint16_t id, const ChannelText& channel);
    mcap::Statistics statistics() const;
    mcap::Bytes summary() const;

    RecordSink& sink_;
    std::uint32_t crc_ = 0;
    std::uint64_t whole_ = 0;
    mcap::Bytes record_;   ///< scratch
    mcap::Bytes schemas_;  ///< records, repeated in the summary
    mcap::Bytes channels_;
    std::vector<mcap::Chunk> chunks_;
    std::vector<mcap::Attachment> attachments_;
    std::vector<mcap::Metadata> metadata_;
    std::map<std::uint16_t, std::uint64_t> messages_of_;  ///< of every channel
};

/// The attachments of a trace, in their order. `Records` is TraceRecords or TraceFile.
template <typename Records>
void write_attachments(Records& records,
                       const world::Recording& recording,
                       mcap::View packed_episode) {
    records.attachment(format::episode_attachment, "application/x-flatbuffers", packed_episode);
    records.attachment(
        format::scenario_attachment, "text/x-lua", mcap::view(recording.episode.scenario));
    records.packed_attachment(format::town_attachment, format::pack(recording.town));
    records.packed_attachment(format::network_attachment, mcap::view(recording.network));
}

}  // namespace reprise::replay
