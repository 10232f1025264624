#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "replay/mcap/files.h"
#include "replay/mcap/mcap.h"

namespace reprise::replay {

/// Where everything is in a trace. Every range was compared with the file's size.
struct TraceIndex {
    std::vector<mcap::Chunk> chunks;
    std::vector<mcap::Attachment> attachments;
    std::vector<mcap::Metadata> metadata;
    std::uint64_t data_end = 0;  ///< where the data section ends: DataEnd, or the cut
    bool whole = true;           ///< false: found by scanning a file without its end
};

/// Reads the index at the end of the file. Nothing when the end is missing. Throws world::Error
/// when it is no trace at all, or the index is damaged.
std::optional<TraceIndex> read_index(const InputFile& file);

/// Walks a file without its end from the start, up to the first record that is not whole.
TraceIndex scan(const InputFile& file);

const mcap::Attachment* find_attachment(const TraceIndex& index, const std::string& name);

const mcap::Metadata* find_metadata(const TraceIndex& index, const std::string& name);

/// The attachment's data, its checksum checked; the second one also unpacks it. Throws world::Error
/// that names the attachment.
mcap::Bytes read_attachment(const InputFile& file,
                            const TraceIndex& index,
                            const std::string& name);
mcap::Bytes read_packed_attachment(const InputFile& file,
                                   const TraceIndex& index,
                                   const std::string& name);

/// Nothing when there is no such metadata. Throws world::Error when it is damaged.
std::optional<std::map<std::string, std::string>> read_metadata(const InputFile& file,
                                                                const TraceIndex& index,
                                                                const std::string& name);

}  // namespace reprise::replay
