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
    static_assert(most % 4 == 0);    // who shades takes them in fours

    SourceGrid() = default;
    SourceGrid(std::vector<LightSource> sources, const Eigen::Vector3f& eye);

    bool empty() const { return sources_.empty(); }

    /// Of what holds a place; negative: none does.
    int cell(const Eigen::Vector3f& position) const;

    /// Indices of those that may reach places in a cell, lobe by lobe.
    std::span<const std::uint16_t> near(int cell) const;

    const LightSource& source(std::uint16_t index) const { return sources_[index]; }

    const SourceRow& row(std::uint16_t index) const { return rows_[index]; }

  private:
    struct Cell {
        std::uint16_t count = 0;
        std::array<std::uint16_t, most> sources{};
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

/// The sources near a place, in fours. Whose last place lay in the same square finds them there.
class NearSources {
  public:
    explicit NearSources(const SourceGrid& grid) : grid_(grid) {}

    void gather(const Eigen::Vector3f& position);

    std::size_t size() const { return near_.size(); }

    const FourSources& four(std::size_t first) const { return fours_[first / 4]; }

    const LightSource& source(std::size_t i) const { return grid_.source(near_[i]); }

  private:
    static constexpr int nowhere = -2;  // neither a cell nor beside all of them

    const SourceGrid& grid_;
    int cell_ = nowhere;
    std::span<const std::uint16_t> near_;
    std::array<FourSources, SourceGrid::most / 4> fours_;
};

}  // namespace reprise::render
