#pragma once

#include <optional>
#include <span>

#include "render/codecs/numbers.h"

namespace reprise::render {

/// How hard PNG's filters and zlib look for what is there again.
enum class PngPacking : std::uint8_t {
    grain,  ///< any filter; no search for strings
    runs,   ///< differences from pixel to pixel; only runs of one value
    areas   ///< differences from pixel to pixel; strings
};

/// 8 or 16 bits, of one channel (grey) or three (colour). An 800x600 picture of colours: 5 ms as
/// grain.
std::vector<std::uint8_t> encode_png(const Numbers& numbers, PngPacking packing);

/// Of a file's bytes, which may be anybody's: nothing where they are no whole PNG. Palettes and
/// less than 8 bits are widened.
std::optional<Numbers> decode_png(std::span<const std::uint8_t> bytes);

}  // namespace reprise::render
