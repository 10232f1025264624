#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/shade/lobes.h"

namespace reprise::render {

/// Which light sources matter where: squares of ground, each with the few that are brightest there.
/// Squares are fixed in the scene, so that an eye that moves changes nothing.
class SourceGrid {
  public:
    static constexpr int most = 20;  ///< in a square

    SourceGrid() = default;
    SourceGrid(std::vector<LightSource> sources, const Eigen::Vector3f& eye);

    bool empty() const { return sources_.empty(); }

    /// Indices of those that may reach a place; behind them others follow, to a multiple of four.
    std::span<const std::uint16_t> near(const Eigen::Vector3f& position) const;

    const LightSource& source(std::uint16_t index) const { return sources_[index]; }

    const SourceRow& row(std::uint16_t index) const { return rows_[index]; }

  private:
    struct Cell {
        std::uint16_t count = 0;
        std::array<std::uint16_t, most> sources{};
        static_assert(most % 4 == 0);
    };

    void enter(std::uint16_t index);
    void drop_faint();
    void sort_by_lobe();
    void enter(std::size_t cell, float rank, std::uint16_t index);

    std::vector<LightSource> sources_;
    std::vector<SourceRow> rows_;  // of each
    std::vector<Cell> cells_;
    std::vector<float> ranks_;  // while it is built: how bright each of a cell's is
    int west_ = 0;              // of the first cell, in cells
    int south_ = 0;
};

}  // namespace reprise::render
