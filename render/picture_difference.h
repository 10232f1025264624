#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace reprise::render {

/// How two pictures of one size differ.
struct PictureDifference {
    double squares = 0;        ///< mean of squared differences, over all numbers
    double largest = 0;        ///< infinity where one of two is no finite number
    double peak = 0;           ///< the largest number there can be; 0: of floats
    int x = 0, y = 0;          ///< of the first pixel that differs, by rows
    std::uint64_t pixels = 0;  ///< that differ
};

/// Of two files that pictures were written to: PNG or EXR. Nothing where they cannot be compared:
/// another size or kind, or no pictures at all.
std::optional<PictureDifference> picture_difference(const std::filesystem::path& expected,
                                                    const std::filesystem::path& found);

}  // namespace reprise::render
