#pragma once

#include <filesystem>

namespace reprise::test {

/// What the first byte of an input says about the rest.
enum InputKind : std::uint8_t {
    whole_file,  ///< a trace as it lies on disk
    records      ///< of a data section: see finished_trace
};

/// Writes small real traces as inputs to start from: as they are, and as records whose chunks and
/// attachments are stored unpacked, so that a flipped byte is a flipped byte of a tick.
void write_seeds(const std::filesystem::path& folder);

}  // namespace reprise::test
