#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace reprise::render {

/// A zlib stream (RFC 1950, 1951) of Huffman codes alone, as pictures full of grain are packed: the
/// bytes that zlib writes at its lowest level with Z_HUFFMAN_ONLY, in a quarter of its time, which
/// goes there through a window that nobody looks into.
std::vector<std::uint8_t> deflate_literals(std::span<const std::uint8_t> bytes);

}  // namespace reprise::render
