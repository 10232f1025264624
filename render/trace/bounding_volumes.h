#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <xmmintrin.h>

namespace reprise::render {

/// Empty until something is added.
struct Box {
    Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
    Eigen::Vector3f high = Eigen::Vector3f::Constant(std::numeric_limits<float>::lowest());

    void add(const Eigen::Vector3f& point) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }

    void add(const Box& other) {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }
};

/// So that rounding in single precision loses nothing that is in it.
Box widened(const Box& box);

/// Rays that go through a tree together: what the boxes need to know of them. A lane with a
/// negative `far` meets no box.
struct Packet {
    static constexpr std::size_t lanes = 8;

    alignas(16) std::array<std::array<float, lanes>, 3> origin;
    alignas(16) std::array<std::array<float, lanes>, 3> inverse;  ///< 1 / direction, finite
    alignas(16) std::array<float, lanes> far;
};

/// A binary tree of boxes over numbered items, by the surface-area heuristic. The same boxes give
/// the same tree: it is built by one thread, out of additions and comparisons.
class BoundingVolumes {
  public:
    /// Some 0.5 us an item.
    BoundingVolumes(std::span<const Box> boxes, std::size_t leaf_size);

    /// The items, leaf by leaf.
    std::span<const std::uint32_t> order() const { return order_; }

    /// Around everything; a point when there is nothing.
    Box bound() const;

    /// Calls `visit(first, last, lanes)` for each leaf that a ray of the packet meets: places in
    /// order(), and a bit for each lane. Roughly from near to far; `visit` may shorten rays.
    template <typename Visit>
    void walk(const Packet& packet, const Visit& visit) const;

  private:
    struct Node {
        std::array<float, 3> low;
        std::uint32_t first;  ///< of a leaf: place in order_; else the second child
        std::array<float, 3> high;
        std::uint16_t count;  ///< 0: an inner node; its first child comes right behind it
        std::uint16_t axis;   ///< that the children lie along, the first one lower
    };

    struct Builder;

    static constexpr std::size_t deepest = 64;

    static unsigned met(const Node& node, const Packet& packet);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

/// Plain SSE2, which every x86-64 CPU has: exact rules for each operation, nothing approximated.
inline unsigned BoundingVolumes::met(const Node& node, const Packet& packet) {
    unsigned lanes = 0;
    for (std::size_t half = 0; half < Packet::lanes; half += 4) {
        __m128 near = _mm_setzero_ps();
        __m128 far = _mm_load_ps(&packet.far[half]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const __m128 origin = _mm_load_ps(&packet.origin[axis][half]);
            const __m128 inverse = _mm_load_ps(&packet.inverse[axis][half]);
            const __m128 low = _mm_mul_ps(_mm_sub_ps(_mm_set1_ps(node.low[axis]), origin), inverse);
            const __m128 high =
                _mm_mul_ps(_mm_sub_ps(_mm_set1_ps(node.high[axis]), origin), inverse);
            near = _mm_max_ps(near, _mm_min_ps(low, high));
            far = _mm_min_ps(far, _mm_max_ps(low, high));
        }
        lanes |= static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(near, far))) << half;
    }
    return lanes;
}

template <typename Visit>
void BoundingVolumes::walk(const Packet& packet, const Visit& visit) const {
    std::array<std::uint32_t, deepest> stack;
    std::size_t size = 0;
    if (!nodes_.empty())
        stack[size++] = 0;
    while (size > 0) {
        const std::uint32_t index = stack[--size];
        const Node& node = nodes_[index];
        const unsigned lanes = met(node, packet);
        if (lanes == 0)
            continue;
        if (node.count > 0) {
            visit(node.first, node.first + node.count, lanes);
            continue;
        }
        // The rays of a packet mostly run the same way: the first one says which child is nearer.
        const auto lane = static_cast<std::size_t>(__builtin_ctz(lanes));
        const bool upwards = packet.inverse[node.axis][lane] > 0;
        stack[size++] = upwards ? node.first : index + 1;
        stack[size++] = upwards ? index + 1 : node.first;
    }
}

}  // namespace reprise::render
