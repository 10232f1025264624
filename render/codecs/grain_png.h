#pragma once

#include <cstdint>
#include <vector>

#include "render/codecs/numbers.h"

namespace reprise::render {

/// A PNG of 8 bits a number whose rows have the filters of least sums and whose codes are
/// Huffman's alone: for pictures full of grain, in which no string is there twice. The bytes that
/// libpng writes so, in a quarter of its time. Numbers as encode_png() takes them.
std::vector<std::uint8_t> encode_grain_png(const Numbers& numbers);

}  // namespace reprise::render
