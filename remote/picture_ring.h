#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "world/external/rig.h"

namespace reprise::remote {

/// A frame of one sensor, and where it lies in the shared memory.
struct PlacedPicture {
    std::uint16_t sensor = 0;  ///< index in the rig
    std::uint64_t tick = 0;
    std::uint64_t offset = 0;             ///< [bytes]
    std::size_t size = 0;                 ///< [bytes] of the frame; where it is to be made: at most
    std::vector<std::uint8_t> reading{};  ///< the frame itself, of what needs no memory
};

/// Where the frames of a rig lie: each sensor has 2 + latency places that are taken in turn. A run
/// renders at most 1 + latency ticks beyond the last answer, so a frame stays as it is until its
/// driver has answered the tick after it.
class PictureRing {
  public:
    PictureRing(const world::Rig& rig, unsigned latency);

    std::size_t bytes() const { return bytes_; }

    /// Those that are due in a tick, as large as they may become.
    std::vector<PlacedPicture> of(std::uint64_t tick) const;

  private:
    const world::Rig rig_;
    std::size_t places_;
    std::vector<std::size_t> starts_;   ///< [bytes] of each sensor's first place
    std::vector<std::size_t> strides_;  ///< [bytes] from one place to the next
    std::size_t bytes_ = 0;
};

}  // namespace reprise::remote
