#include "render/shade/source_grid.h"

#include <algorithm>

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr float cell_size = 8;  // [m]
constexpr int side = 90;        // [cells] the grid reaches 360 m from the eye

int cell_of(float metres) {
    return floor_int(metres / cell_size);
}

/// Of its intensity, at a height where nothing is lost, so far aside of straight ahead: see
/// lobes.h.
float low_beam_share(float aside) {
    const auto bell = [](float x) { return (1 + x * x) * (1 + x * x); };
    return 0.77F / bell(aside / 0.20F) + 0.23F / bell(aside);
}

/// About how bright a source makes the brightest place of a square; 0 where it does not reach.
float rank_of(const LightSource& source, float x, float y) {
    constexpr float half = cell_size / 2;
    constexpr float diagonal = 1.4142136F * half;
    const float dx = x - source.position.x();
    const float dy = y - source.position.y();
    const float near_x = std::max(std::abs(dx) - half, 0.0F);
    const float near_y = std::max(std::abs(dy) - half, 0.0F);
    const float squared = near_x * near_x + near_y * near_y;
    if (squared >= source.reach * source.reach)
        return 0;
    float share = 1;
    if (source.lobe == LightSource::Lobe::low_beam) {
        const float ahead = dx * source.axis.x() + dy * source.axis.y() + diagonal;
        const float across = std::abs(dx * source.left.x() + dy * source.left.y()) - diagonal;
        if (ahead < 0)
            return 0;
        share = 0.4F * low_beam_share(std::max(across, 0.0F) / std::max(ahead, 0.25F));
    } else if (source.lobe == LightSource::Lobe::lens || source.lobe == LightSource::Lobe::signal ||
               source.lobe == LightSource::Lobe::window) {
        if (dx * source.axis.x() + dy * source.axis.y() < -6)
            return 0;
    }
    const float fade = 1 - squared / (source.reach * source.reach);
    return luminance(source.intensity) * share * fade * fade / (squared + 9);
}

}  // namespace

SourceGrid::SourceGrid(std::vector<LightSource> sources, const Vector3f& eye)
    : sources_(std::move(sources)) {
    if (sources_.empty())
        return;
    sources_.resize(std::min<std::size_t>(sources_.size(), 65535));
    rows_ = std::vector<SourceRow>(sources_.begin(), sources_.end());
    west_ = cell_of(eye.x()) - side / 2;
    south_ = cell_of(eye.y()) - side / 2;
    cells_.resize(static_cast<std::size_t>(side) * side);
    ranks_.resize(cells_.size() * most);
    for (std::size_t i = 0; i < sources_.size(); ++i)
        enter(static_cast<std::uint16_t>(i));
    drop_faint();
    sort_by_lobe();
    ranks_.clear();
}

/// Those that give less than a part in 250 of the brightest cost as much, and show nothing. But a
/// head lamp leaves dark what is behind it: what can be seen in the dark stays.
void SourceGrid::drop_faint() {
    constexpr float seen = 0.2F * lux / pi;
    for (std::size_t at = 0; at < cells_.size(); ++at) {
        const float* ranks = &ranks_[at * most];
        const float faint = std::min(0.004F * ranks[0], seen);
        std::uint16_t& count = cells_[at].count;
        while (count > 1 && ranks[count - 1] < faint)
            --count;
    }
}

/// Each four has as few kinds as can be: every kind takes its time.
void SourceGrid::sort_by_lobe() {
    const auto before = [&](std::uint16_t a, std::uint16_t b) {
        const LightSource::Lobe of_a = sources_[a].lobe;
        const LightSource::Lobe of_b = sources_[b].lobe;
        return of_a != of_b ? of_a > of_b : a < b;
    };
    for (Cell& cell : cells_)
        std::sort(cell.sources.begin(), cell.sources.begin() + cell.count, before);
}

void SourceGrid::enter(std::uint16_t index) {
    const LightSource& source = sources_[index];
    const auto clamped = [](int cell) { return std::clamp(cell, 0, side - 1); };
    const int left = clamped(cell_of(source.position.x() - source.reach) - west_);
    const int right = clamped(cell_of(source.position.x() + source.reach) - west_);
    const int low = clamped(cell_of(source.position.y() - source.reach) - south_);
    const int high = clamped(cell_of(source.position.y() + source.reach) - south_);
    for (int row = low; row <= high; ++row) {
        for (int column = left; column <= right; ++column) {
            const float x = (static_cast<float>(west_ + column) + 0.5F) * cell_size;
            const float y = (static_cast<float>(south_ + row) + 0.5F) * cell_size;
            const float rank = rank_of(source, x, y);
            if (rank > 0)
                enter(static_cast<std::size_t>(row * side + column), rank, index);
        }
    }
}

/// Keeps the brightest, brighter ones first; of two that are alike the earlier one.
void SourceGrid::enter(std::size_t at, float rank, std::uint16_t index) {
    Cell& cell = cells_[at];
    float* ranks = &ranks_[at * most];
    std::size_t place = cell.count;
    while (place > 0 && ranks[place - 1] < rank)
        --place;
    if (place == most)
        return;
    cell.count = static_cast<std::uint16_t>(std::min<std::size_t>(cell.count + 1u, most));
    for (std::size_t i = cell.count - 1u; i > place; --i) {
        cell.sources[i] = cell.sources[i - 1];
        ranks[i] = ranks[i - 1];
    }
    cell.sources[place] = index;
    ranks[place] = rank;
}

int SourceGrid::cell(const Vector3f& position) const {
    const int column = cell_of(position.x()) - west_;
    const int row = cell_of(position.y()) - south_;
    const bool inside = !cells_.empty() && column >= 0 && column < side && row >= 0 && row < side;
    return inside ? row * side + column : -1;
}

std::span<const std::uint16_t> SourceGrid::near(int cell) const {
    if (cell < 0)
        return {};
    const Cell& here = cells_[static_cast<std::size_t>(cell)];
    return std::span(here.sources).first(here.count);
}

void NearSources::gather(const Vector3f& position) {
    const int cell = grid_.cell(position);
    if (cell == cell_)
        return;
    cell_ = cell;
    near_ = grid_.near(cell);
    // The last four is filled up with its last one, which nobody counts.
    const auto row = [&](std::size_t i) -> const SourceRow& {
        return grid_.row(near_[std::min(i, near_.size() - 1)]);
    };
    for (std::size_t i = 0; i < near_.size(); i += 4)
        fours_[i / 4] = FourSources(row(i), row(i + 1), row(i + 2), row(i + 3));
}

}  // namespace reprise::render
