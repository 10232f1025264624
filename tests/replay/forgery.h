#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "replay/mcap/mcap.h"

/// Traces as somebody changed them who knows the format: with every checksum made right again.
namespace reprise::test {

/// A record of the data section or of the summary.
struct FileRecord {
    replay::mcap::Op op{};
    std::size_t from = 0;  ///< of its prefix in the file
    std::size_t size = 0;  ///< with its prefix
};

std::vector<FileRecord> records_of(const std::vector<std::uint8_t>& file);

/// Makes the checksums of chunks, attachments, metadata, the data section and the summary right,
/// as far as the records can still be walked.
void repair_checksums(std::vector<std::uint8_t>& file);

/// Puts a record at the end of the data section, or of the summary, and moves what lies behind it.
void insert_record(std::vector<std::uint8_t>& file,
                   const std::vector<std::uint8_t>& record,
                   bool in_summary);

/// What its chunks and packed attachments unpack to, one behind another: what counts of them.
std::vector<std::uint8_t> unpacked_parts(const std::vector<std::uint8_t>& file);

}  // namespace reprise::test
