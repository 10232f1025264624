#pragma once

#include <optional>
#include <span>

#include "render/codecs/numbers.h"

namespace reprise::render {

/// 32-bit floats of one channel (Y) or three (R, G, B), ZIP packed, as https://openexr.com has it.
std::vector<std::uint8_t> encode_exr(const Numbers& numbers);

/// Of a file's bytes, which may be anybody's: its channels as floats, by their names. Nothing where
/// they are no whole OpenEXR.
std::optional<Numbers> decode_exr(std::span<const std::uint8_t> bytes);

}  // namespace reprise::render
