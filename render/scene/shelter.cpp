#include "render/scene/shelter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float cell_size = 0.5F;  // [m]
constexpr int tile_cells = 32;     // along a tile_side
constexpr float tile_side = cell_size * tile_cells;
constexpr float lowest_roof = 1.2F;   // [m] above what it keeps dry
constexpr float least_roof = 0.15F;   // [m2] of a triangle; wires and arms of lamps are less
constexpr float most_ground = 40e3F;  // [m2]; only the grass up to the horizon is more
constexpr float least_gap = 2.2F;     // [m] between ground and roof, for a tile to be looked at
constexpr float nowhere = -std::numeric_limits<float>::infinity();

bool can_be_roof(const Instance& instance) {
    return instance.kind == Kind::ground || instance.kind == Kind::town ||
           instance.kind == Kind::prop;
}

/// Calls `work(corners)` for each triangle that rain falls onto from above.
template <typename Work>
void for_roofs(std::span<const Instance> still, const Work& work) {
    for (const Instance& instance : still) {
        if (!can_be_roof(instance))
            continue;
        const Mesh& mesh = instance.prototype->mesh;
        const Eigen::Affine3f pose = instance.pose.cast<float>();
        for (const auto& triangle : mesh.triangles) {
            std::array<Vector3f, 3> corners;
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = pose * mesh.vertices[triangle[i]];
            const Vector3f normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            const float twice_area = normal.norm();
            if (normal.z() > 0.2F * twice_area && twice_area > 2 * least_roof &&
                twice_area < 2 * most_ground)
                work(corners);
        }
    }
}

struct Bounds {
    Vector3f low, high;
};

Bounds bounds_of(const std::array<Vector3f, 3>& corners) {
    return {corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]),
            corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])};
}

int index_of(float offset, float size, int count) {
    return std::clamp(floor_int(offset / size), 0, count - 1);
}

float cross2(const Vector2f& a, const Vector2f& b) {
    return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Shelter::Shelter(std::span<const Instance> still) {
    Vector2f high = Vector2f::Constant(nowhere);
    low_ = -high;
    for_roofs(still, [&](const Corners& corners) {
        const Bounds box = bounds_of(corners);
        low_ = low_.cwiseMin(box.low.head<2>());
        high = high.cwiseMax(box.high.head<2>());
    });
    if (!(low_.x() < high.x()))
        return;
    columns_ = 1 + floor_int((high.x() - low_.x()) / tile_side);
    rows_ = 1 + floor_int((high.y() - low_.y()) / tile_side);
    const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    // Where is anything higher than something else?
    std::vector<std::array<float, 2>> spans(count, {-nowhere, nowhere});
    for_roofs(still, [&](const Corners& corners) {
        const Bounds box = bounds_of(corners);
        for (int y = index_of(box.low.y() - low_.y(), tile_side, rows_);
             y <= index_of(box.high.y() - low_.y(), tile_side, rows_);
             ++y)
            for (int x = index_of(box.low.x() - low_.x(), tile_side, columns_);
                 x <= index_of(box.high.x() - low_.x(), tile_side, columns_);
                 ++x) {
                auto& span = spans[static_cast<std::size_t>(y * columns_ + x)];
                span[0] = std::min(span[0], box.low.z());
                span[1] = std::max(span[1], box.high.z());
            }
    });
    tiles_.assign(count, -1);
    std::size_t used = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (spans[i][1] - spans[i][0] > least_gap)
            tiles_[i] = static_cast<std::int32_t>(used++);
    tops_.assign(used * tile_cells * tile_cells, nowhere);
    for_roofs(still, [&](const Corners& corners) { raise(corners); });
}

/// Where cells' middles lie in the triangle, nothing below it gets wet.
void Shelter::raise(const Corners& corners) {
    const Vector2f a = corners[0].head<2>() - low_;
    const Vector2f ab = corners[1].head<2>() - low_ - a;
    const Vector2f ac = corners[2].head<2>() - low_ - a;
    const float area = cross2(ab, ac);
    const Bounds box = bounds_of(corners);
    const int left = index_of(box.low.x() - low_.x(), cell_size, columns_ * tile_cells);
    const int right = index_of(box.high.x() - low_.x(), cell_size, columns_ * tile_cells);
    const int low = index_of(box.low.y() - low_.y(), cell_size, rows_ * tile_cells);
    const int high = index_of(box.high.y() - low_.y(), cell_size, rows_ * tile_cells);
    for (int y = low; y <= high; ++y) {
        for (int x = left; x <= right; ++x) {
            const std::int32_t tile =
                tiles_[static_cast<std::size_t>(y / tile_cells * columns_ + x / tile_cells)];
            if (tile < 0) {
                x |= tile_cells - 1;  // on to the next tile
                continue;
            }
            const Vector2f at =
                Vector2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) * cell_size -
                a;
            const float b = cross2(at, ac) / area;
            const float c = cross2(ab, at) / area;
            if (b < 0 || c < 0 || b + c > 1)
                continue;
            const float z = (1 - b - c) * corners[0].z() + b * corners[1].z() + c * corners[2].z();
            float& top = tops_[static_cast<std::size_t>(
                (tile * tile_cells + y % tile_cells) * tile_cells + x % tile_cells)];
            top = std::max(top, z);
        }
    }
}

float Shelter::top(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ * tile_cells || row >= rows_ * tile_cells)
        return nowhere;
    const std::int32_t tile =
        tiles_[static_cast<std::size_t>(row / tile_cells * columns_ + column / tile_cells)];
    if (tile < 0)
        return nowhere;
    return tops_[static_cast<std::size_t>((tile * tile_cells + row % tile_cells) * tile_cells +
                                          column % tile_cells)];
}

float Shelter::openness(const Vector3f& place) const {
    const float x = (place.x() - low_.x()) / cell_size - 0.5F;
    const float y = (place.y() - low_.y()) / cell_size - 0.5F;
    const float reach = static_cast<float>(tile_cells);
    if (!(x > -reach && y > -reach && x < reach * static_cast<float>(columns_ + 1) &&
          y < reach * static_cast<float>(rows_ + 1)))
        return 1;
    const int column = floor_int(x);
    const int row = floor_int(y);
    const auto open = [&](int i, int j) {
        return place.z() + lowest_roof < top(column + i, row + j) ? 0.0F : 1.0F;
    };
    const float fx = x - static_cast<float>(column);
    const float fy = y - static_cast<float>(row);
    return mix(mix(open(0, 0), open(1, 0), fx), mix(open(0, 1), open(1, 1), fx), fy);
}

}  // namespace reprise::render
