#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "world/external/sensor.h"

namespace reprise::render {

/// A picture's numbers: rows from the top, pixels from the left, channels interleaved, red first;
/// in the machine's byte order.
struct Numbers {
    int width = 0;
    int height = 0;
    int channels = 0;
    world::PixelType type = world::PixelType::u8;
    std::vector<std::uint8_t> data{};

    std::size_t row_bytes() const {
        return world::bytes_of(type) * static_cast<std::size_t>(channels) *
               static_cast<std::size_t>(width);
    }
};

/// More pixels than any picture of ours has; a file that says it has more is not read.
inline constexpr std::int64_t most_pixels_read = std::int64_t{1} << 26;

}  // namespace reprise::render
