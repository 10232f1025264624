#pragma once

#include <cstdint>

#include "world/random.h"

namespace reprise::towns {

/// Draws for one item of one kind of thing, one after the other. Another item's draws never shift
/// these. One draw in an argument list at most: compilers choose the order there.
class Draws {
  public:
    Draws(std::uint64_t seed, world::Purpose purpose, std::uint64_t item)
        : seed_(seed),
          purpose_(purpose),
          item_(item) {}

    double between(double low, double high) {
        return low + (high - low) * world::draw(seed_, item_, purpose_, count_++);
    }

    bool chance(double share) { return between(0, 1) < share; }

    /// In [0, count).
    std::uint32_t index(std::size_t count) {
        return static_cast<std::uint32_t>(
            world::draw_index(count, seed_, item_, purpose_, count_++));
    }

    std::uint32_t style() { return index(65536); }

  private:
    std::uint64_t seed_;
    world::Purpose purpose_;
    std::uint64_t item_;
    std::uint64_t count_ = 0;
};

}  // namespace reprise::towns
