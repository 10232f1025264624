#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "replay/mcap/compression.h"
#include "replay/mcap/files.h"
#include "replay/mcap/mcap.h"
#include "replay/trace_reader.h"

namespace reprise::replay {

/// The message records of some ticks, on their way into one chunk.
struct PendingChunk {
    struct Message {
        std::uint16_t channel;
        std::uint64_t log_time;
        std::uint64_t offset;  ///< of the record in `records`
    };

    mcap::Bytes records;
    std::vector<Message> messages;

    void add(std::uint16_t channel, std::uint64_t tick, std::uint64_t log_time, mcap::View data);

    void clear() {
        records.clear();
        messages.clear();
    }
};

/// A trace as it grows: writes records behind one another, keeps the checksum and what the index at
/// the end needs (about 150 bytes a chunk). Used by one thread at a time.
class TraceFile {
  public:
    /// Magic, header, and the schemas and channels that a trace of this level has.
    TraceFile(const std::filesystem::path& path, Level level);

    /// A stream of another kind of file, and the schema that describes its messages.
    struct Channel {
        std::string topic;
        std::string schema;
        std::string schema_encoding;
        std::string schema_text;
        std::string message_encoding;
    };

    /// The same for another kind of file: its channels are numbered from 1.
    TraceFile(const std::filesystem::path& path, const std::vector<Channel>& channels);

    void metadata(const std::string& name, const std::map<std::string, std::string>& texts);
    void attachment(const std::string& name, const std::string& media_type, mcap::View data);
    void packed_attachment(const std::string& name, mcap::View data);

    /// Compresses and writes; the message indexes follow. Nothing for an empty chunk.
    void chunk(const PendingChunk& chunk);

    /// Data end, summary, footer, magic; then the file gets its name.
    void finish();

    /// After an error, or when the run gave up: leaves PATH.partial with its whole chunks; removes
    /// it when it has none.
    void abandon() noexcept;

    /// Removes what was written.
    void discard() noexcept { file_.remove(); }

    bool has_chunks() const { return !chunks_.empty(); }

    const std::filesystem::path& partial() const { return file_.partial(); }

  private:
    void put(mcap::View bytes);
    void start(const std::vector<Channel>& channels);
    void describe(std::uint16_t id, const Channel& channel);
    mcap::Statistics statistics() const;
    mcap::Bytes summary() const;

    OutputFile file_;
    Compressor compressor_;
    std::uint32_t crc_ = 0;
    std::uint64_t whole_ = 0;  ///< where the last whole record ends
    mcap::Bytes record_;       ///< scratch
    mcap::Bytes schemas_;      ///< records, repeated in the summary
    mcap::Bytes channels_;
    std::vector<mcap::Chunk> chunks_;
    std::vector<mcap::Attachment> attachments_;
    std::vector<mcap::Metadata> metadata_;
    std::map<std::uint16_t, std::uint64_t> messages_of_;  ///< of every channel
};

}  // namespace reprise::replay
