#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "render/shapes/fast_math.h"

namespace reprise::render {

/// Squares of ground from which a short ray may meet somebody who moves; from all others it surely
/// does not. Squares that lie a multiple of a kilometre apart are one, so that no town is too
/// large.
class CrowdMap {
  public:
    static constexpr float reach = 3;  ///< [m] how long short rays are at most

    /// Anybody may be anywhere, or nobody is there.
    void fill(bool everywhere) {
        for (auto& row : rows_)
            row.fill(everywhere ? ~std::uint64_t{0} : 0);
    }

    /// Somebody is inside of this ball. [m] scene
    void add(const Eigen::Vector3d& middle, double radius) {
        const auto all = static_cast<float>(radius) + reach + 0.1F;  // rounding
        const auto x = static_cast<float>(middle.x());
        const auto y = static_cast<float>(middle.y());
        const auto cells = [](float low, float high) {
            return std::min(floor_int(high / cell) - floor_int(low / cell), side - 1);
        };
        for (int row = 0; row <= cells(y - all, y + all); ++row)
            for (int column = 0; column <= cells(x - all, x + all); ++column)
                mark(floor_int((x - all) / cell) + column, floor_int((y - all) / cell) + row);
    }

    bool is_near(float x, float y) const {
        const unsigned column = wrapped(floor_int(x / cell));
        const unsigned row = wrapped(floor_int(y / cell));
        return (rows_[row][column / 64] >> column % 64 & 1U) != 0;
    }

  private:
    static constexpr float cell = 4;  // [m]
    static constexpr int side = 256;  // [cells]

    static unsigned wrapped(int number) { return static_cast<unsigned>(number) % side; }

    void mark(int x, int y) {
        const unsigned column = wrapped(x);
        rows_[wrapped(y)][column / 64] |= std::uint64_t{1} << column % 64;
    }

    std::array<std::array<std::uint64_t, side / 64>, side> rows_{};
};

}  // namespace reprise::render
