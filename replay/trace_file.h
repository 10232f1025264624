#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "files/output_file.h"
#include "replay/mcap/compression.h"
#include "replay/mcap/mcap.h"
#include "replay/trace_reader.h"
#include "replay/trace_records.h"

namespace reprise::replay {

/// A trace as it grows in a file. Used by one thread at a time.
class TraceFile {
  public:
    using Channel = ChannelText;

    /// Magic, header, and the schemas and channels that a trace of this level has.
    TraceFile(const std::filesystem::path& path, Level level, files::Unfinished unfinished);

    /// The same for another kind of file. `what` it is, for messages.
    TraceFile(const std::filesystem::path& path,
              const std::vector<Channel>& channels,
              files::Unfinished unfinished = files::Unfinished::remove,
              const std::string& what = "the trace");

    void metadata(const std::string& name, const std::map<std::string, std::string>& texts) {
        records_->metadata(name, texts);
    }

    void attachment(const std::string& name, const std::string& media_type, mcap::View data) {
        records_->attachment(name, media_type, data);
    }

    void packed_attachment(const std::string& name, mcap::View data) {
        records_->packed_attachment(name, data);
    }

    /// Compresses and writes; the message indexes follow. Nothing for an empty chunk.
    void chunk(const PendingChunk& chunk) { records_->chunk(chunk); }

    /// Data end, summary, footer, magic; then the file gets its name.
    void finish();

    /// After an error, or when the run gave up: leaves PATH.partial with its whole chunks; removes
    /// it when it has none.
    void abandon() noexcept;

    /// Removes what was written.
    void discard() noexcept { sink_.file.remove(); }

    bool has_chunks() const { return records_ && records_->has_chunks(); }

    const std::filesystem::path& partial() const { return sink_.file.partial(); }

  private:
    struct Sink : RecordSink {
        files::OutputFile file;
        Compressor compressor;

        Sink(const std::filesystem::path& path,
             const std::string& what,
             files::Unfinished unfinished)
            : file(path, what, unfinished) {}

        void put(mcap::View bytes) override { file.append(bytes); }

        std::uint64_t size() const override { return file.size(); }

        mcap::View pack(mcap::View data) override { return compressor.compress(data); }
    };

    Sink sink_;
    std::unique_ptr<TraceRecords> records_;
};

}  // namespace reprise::replay
