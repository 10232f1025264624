// Private to the room.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "replay/mcap/mcap.h"

namespace reprise::replay {

/// Message data lies anywhere in a chunk; FlatBuffers need it 8-aligned.
class AlignedCopy {
  public:
    /// The same bytes; they live until the next call.
    mcap::View of(mcap::View bytes) {
        if (words_.size() * 8 < bytes.size())
            words_.resize(bytes.size() / 8 + 1);
        std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::uint8_t*>(words_.data()));
        return {reinterpret_cast<const std::uint8_t*>(words_.data()), bytes.size()};
    }

  private:
    std::vector<std::uint64_t> words_;
};

}  // namespace reprise::replay
