#include "kernel/physics/ray_grid.h"

#include <algorithm>

#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>

#include "world/check.h"

namespace reprise::kernel {

namespace {

constexpr std::size_t quantized = 65536;  ///< values of a coordinate
constexpr std::size_t cells_a_leaf = 4;   ///< at most, on average

bool overlap(const std::array<std::uint16_t, 3>& low,
             const std::array<std::uint16_t, 3>& high,
             const std::array<std::uint16_t, 3>& other_low,
             const std::array<std::uint16_t, 3>& other_high) {
    return low[0] <= other_high[0] && high[0] >= other_low[0] &&  //
           low[1] <= other_high[1] && high[1] >= other_low[1] &&  //
           low[2] <= other_high[2] && high[2] >= other_low[2];
}

/// As btQuantizedBvh::walkStacklessQuantizedTreeAgainstRay prepares it.
struct Ray {
    Ray(const btVector3& from, const btVector3& to) : from(from) {
        btVector3 direction = to - from;
        direction.safeNormalize();
        length = direction.dot(to - from);
        for (int axis = 0; axis < 3; ++axis) {
            inverse[axis] = direction[axis] == 0 ? BT_LARGE_FLOAT : 1 / direction[axis];
            sign[axis] = inverse[axis] < 0 ? 1 : 0;
        }
    }

    bool meets(const btVector3& low, const btVector3& high) const {
        const btVector3 bounds[2] = {low, high};
        btScalar nearest = 1;
        return btRayAabb2(from, inverse, sign, bounds, nearest, 0, length);
    }

    btVector3 from;
    btVector3 inverse;  ///< one by the direction
    unsigned sign[3];
    btScalar length;
};

}  // namespace

template <typename Visit>
void RayGrid::for_each_cell(const Leaf& box, Visit&& visit) const {
    for (std::size_t row = box.low[1] >> shift_; row <= std::size_t{box.high[1]} >> shift_; ++row)
        for (std::size_t column = box.low[0] >> shift_;
             column <= std::size_t{box.high[0]} >> shift_;
             ++column)
            visit(row * columns_ + column);
}

RayGrid::RayGrid(btOptimizedBvh& hierarchy, std::vector<Corners> triangles)
    : hierarchy_(&hierarchy),
      triangles_(std::move(triangles)) {
    std::vector<Leaf> all;
    const QuantizedNodeArray& nodes = hierarchy.getQuantizedNodeArray();
    // A binary tree; Bullet's array holds one node more, which means nothing.
    const int count = 2 * static_cast<int>(triangles_.size()) - 1;
    REPRISE_CHECK(count <= nodes.size(), std::to_string(nodes.size()) + " nodes");
    for (int i = 0; i < count; ++i) {
        if (!nodes[i].isLeafNode())
            continue;
        Leaf leaf{{}, {}, nodes[i].getTriangleIndex()};
        std::copy_n(nodes[i].m_quantizedAabbMin, 3, leaf.low.begin());
        std::copy_n(nodes[i].m_quantizedAabbMax, 3, leaf.high.begin());
        all.push_back(leaf);
    }
    REPRISE_CHECK(all.size() == triangles_.size(), std::to_string(all.size()) + " leaves");

    while ((quantized >> shift_) * (quantized >> shift_) > cells_a_leaf * all.size())
        ++shift_;
    columns_ = quantized >> shift_;
    begin_.assign(columns_ * columns_ + 1, 0);
    for (const Leaf& leaf : all)
        for_each_cell(leaf, [&](std::size_t cell) { ++begin_[cell + 1]; });
    for (std::size_t cell = 1; cell < begin_.size(); ++cell)
        begin_[cell] += begin_[cell - 1];
    leaves_.resize(begin_.back());
    std::vector<std::uint32_t> next = begin_;
    for (const Leaf& leaf : all)
        for_each_cell(leaf, [&](std::size_t cell) { leaves_[next[cell]++] = leaf; });
}

void RayGrid::cast(btTriangleCallback& callback, const btVector3& from, const btVector3& to) const {
    const Ray ray(from, to);
    btVector3 low = from;
    low.setMin(to);
    btVector3 high = from;
    high.setMax(to);
    Leaf query{{}, {}, 0};
    hierarchy_->quantizeWithClamp(query.low.data(), low, 0);
    hierarchy_->quantizeWithClamp(query.high.data(), high, 1);
    for_each_cell(query, [&](std::size_t cell) {
        for (std::uint32_t i = begin_[cell]; i < begin_[cell + 1]; ++i) {
            const Leaf& leaf = leaves_[i];
            if (!overlap(leaf.low, leaf.high, query.low, query.high) ||
                !ray.meets(hierarchy_->unQuantize(leaf.low.data()),
                           hierarchy_->unQuantize(leaf.high.data())))
                continue;
            const auto triangle = static_cast<std::size_t>(leaf.triangle);
            Corners corners = triangles_[triangle];
            callback.processTriangle(corners.data(), 0, leaf.triangle);
        }
    });
}

}  // namespace reprise::kernel
