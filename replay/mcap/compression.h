#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "replay/mcap/mcap.h"

namespace reprise::replay {

/// No chunk and no attachment is larger than this when unpacked: what a hostile file can make us
/// allocate.
inline constexpr std::uint64_t largest_unpacked = std::uint64_t{256} << 20;

/// zstd, one frame at a time, level 1: noisy mantissas do not shrink further at higher levels.
/// About 300 MB/s in, 1 GB/s out.
class Compressor {
  public:
    Compressor();
    ~Compressor();
    Compressor(const Compressor&) = delete;
    Compressor& operator=(const Compressor&) = delete;

    /// Borrowed until the next call; equal bytes give equal bytes.
    mcap::View compress(mcap::View bytes);

  private:
    struct Context;
    std::unique_ptr<Context> context_;
};

class Decompressor {
  public:
    Decompressor();
    ~Decompressor();
    Decompressor(const Decompressor&) = delete;
    Decompressor& operator=(const Decompressor&) = delete;

    /// True when the frame is sound and unpacks to exactly out.size() bytes.
    bool decompress(mcap::View frame, std::span<std::uint8_t> out);

    /// As many bytes as a damaged frame gives before it breaks; the rest of `out` is left alone.
    std::size_t salvage(mcap::View frame, std::span<std::uint8_t> out);

  private:
    struct Context;
    std::unique_ptr<Context> context_;
};

/// Whether these bytes are one frame and nothing else: zstd skips frames of foreign bytes.
bool is_one_frame(mcap::View bytes);

/// What the frame says it unpacks to; nothing when it is no zstd frame, does not say, or says more
/// than largest_unpacked.
std::optional<std::uint64_t> unpacked_size(mcap::View frame);

}  // namespace reprise::replay
