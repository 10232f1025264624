#pragma once

#include <cstdint>
#include <vector>

#include "remote/client.h"

namespace reprise::wheel {

/// Rows from the top, pixels from the left, R, G, B.
struct Image {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
    std::vector<std::uint8_t> rgb;
};

/// A frame as people look at it: classes in colours like those of the day, depth as gray, black
/// near, on a logarithmic scale from 1 m to 1 km.
Image image_of(const remote::Client::Picture& picture);

}  // namespace reprise::wheel
