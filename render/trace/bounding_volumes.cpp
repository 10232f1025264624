// What it must do: find few boxes for a ray, in the same way on every CPU.
// What it assumes: boxes are finite.
// How it goes: items are sorted into 16 bins along the widest spread of their middles, and parted
//   where area times number is least (Wald, "On fast Construction of SAH-based Bounding Volume
//   Hierarchies", 2007); halves by number where that would become too deep.
// What it keeps: nodes in the order of a walk, first children right behind their parents.
#include "render/trace/bounding_volumes.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr std::size_t bins = 16;

float area(const Box& box) {
    const Vector3f size = (box.high - box.low).cwiseMax(0.0F);
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

struct Bin {
    Box box;
    std::size_t count = 0;
};

}  // namespace

Box widened(const Box& box) {
    const float largest = box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff();
    const Vector3f margin = Vector3f::Constant(1e-3F + 1e-6F * largest);  // [m]
    return {box.low - margin, box.high + margin};
}

struct BoundingVolumes::Builder {
    std::span<const Box> boxes;
    std::size_t leaf_size;
    BoundingVolumes& tree;
    std::vector<Vector3f> middles;

    std::size_t bin_of(std::uint32_t item, int axis, float low, float scale) const {
        const float place = (middles[item][axis] - low) * scale;
        return std::min(bins - 1, static_cast<std::size_t>(place));
    }

    /// Where the cheapest border between two bins is: the number of the first bin behind it.
    static std::size_t cheapest(const std::array<Bin, bins>& filled) {
        std::array<float, bins> behind{};  // [i]: cost of the bins from i on
        Bin sum;
        for (std::size_t i = bins - 1; i > 0; --i) {
            sum.box.add(filled[i].box);
            sum.count += filled[i].count;
            behind[i] = area(sum.box) * static_cast<float>(sum.count);
        }
        sum = {};
        std::size_t best = 1;
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t i = 1; i < bins; ++i) {
            sum.box.add(filled[i - 1].box);
            sum.count += filled[i - 1].count;
            const float cost = area(sum.box) * static_cast<float>(sum.count) + behind[i];
            if (cost < least) {
                least = cost;
                best = i;
            }
        }
        return best;
    }

    /// Sorts the items of [first, last) into two parts and returns where the second begins.
    std::size_t part(std::size_t first, std::size_t last, int axis, const Box& spread) {
        const auto begin = tree.order_.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = tree.order_.begin() + static_cast<std::ptrdiff_t>(last);
        const float low = spread.low[axis];
        const float scale = static_cast<float>(bins) / (spread.high[axis] - low);
        std::array<Bin, bins> filled;
        for (auto item = begin; item != end; ++item) {
            Bin& bin = filled[bin_of(*item, axis, low, scale)];
            bin.box.add(boxes[*item]);
            ++bin.count;
        }
        const std::size_t border = cheapest(filled);
        const auto middle = std::stable_partition(begin, end, [&](std::uint32_t item) {
            return bin_of(item, axis, low, scale) < border;
        });
        return static_cast<std::size_t>(middle - tree.order_.begin());
    }

    void build(std::size_t first, std::size_t last, std::size_t depth) {
        Box bound;
        Box spread;
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t item = tree.order_[i];
            bound.add(boxes[item]);
            spread.add(middles[item]);
        }
        const std::size_t own = tree.nodes_.size();
        tree.nodes_.push_back({{bound.low.x(), bound.low.y(), bound.low.z()},
                               static_cast<std::uint32_t>(first),
                               {bound.high.x(), bound.high.y(), bound.high.z()},
                               0,
                               0});
        if (last - first <= leaf_size) {
            tree.nodes_[own].count = static_cast<std::uint16_t>(last - first);
            return;
        }
        int axis = 0;
        const float widest = (spread.high - spread.low).maxCoeff(&axis);
        std::size_t middle = first + (last - first) / 2;
        if (widest > 1e-6F && depth < deepest / 2)
            middle = part(first, last, axis, spread);
        if (middle == first || middle == last)
            middle = first + (last - first) / 2;
        tree.nodes_[own].axis = static_cast<std::uint16_t>(axis);
        build(first, middle, depth + 1);
        tree.nodes_[own].first = static_cast<std::uint32_t>(tree.nodes_.size());
        build(middle, last, depth + 1);
    }
};

BoundingVolumes::BoundingVolumes(std::span<const Box> boxes, std::size_t leaf_size)
    : order_(boxes.size()) {
    if (boxes.empty())
        return;
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(2 * boxes.size() / leaf_size);
    Builder builder{boxes, leaf_size, *this, {}};
    for (const Box& box : boxes)
        builder.middles.emplace_back((box.low + box.high) * 0.5F);
    builder.build(0, boxes.size(), 1);
}

Box BoundingVolumes::bound() const {
    if (nodes_.empty())
        return {Vector3f::Zero(), Vector3f::Zero()};
    const Node& root = nodes_.front();
    return {{root.low[0], root.low[1], root.low[2]}, {root.high[0], root.high[1], root.high[2]}};
}

}  // namespace reprise::render
