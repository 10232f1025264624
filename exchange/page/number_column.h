#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace reprise::exchange {

/// Whole numbers as bytes, small ones in one: zigzag (0, -1, 1, -2, ... are 0, 1, 2, 3, ...), then
/// seven bits a byte, the lowest first, the eighth where more follow. Differences of what moves
/// smoothly are small, and zlib presses columns of them to a bit or two each.
class NumberColumn {
  public:
    /// |value| < 2^31: a browser's bit operations know 32 bits.
    void append(std::int64_t value);

    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// To steps of 1 / `per_unit`; what is no number becomes 0, what is too far away the farthest
/// place.
std::int64_t quantised(double value, double per_unit);

/// RFC 1950, as a browser's DecompressionStream('deflate') reads it.
std::string pressed(std::string_view bytes);

}  // namespace reprise::exchange
