// Must: find the rests of sidewalk that cars leave over between their paths; leave alone what joins
//   a real sidewalk, and refuges on crossings.
// Assumes: patches of one slab do not touch each other; others may touch, overlap or repeat.
// Goes: from each small patch to all that it is joined to, until that is too large for a splinter.
// Keeps: patches are dropped as whole islands, so that no sidewalk loses its end.
#include "ground/mesh/splinters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reprise::ground {

namespace {

constexpr double joined_step = 0.25;  ///< [m] patches that meet and differ by more are not joined

/// Clear of the border of a hole in which it lies?
bool lies_in_a_hole(const Patch& inner, const Patch& outer) {
    const world::Loop& outline = inner.borders[0];
    const auto holds = [&](const world::Loop& hole) {
        if (!world::contains(hole, outline[0]))
            return false;
        for (std::size_t i = 0; i < hole.size(); ++i)
            if (world::distance_to(outline, hole[i], hole[(i + 1) % hole.size()]) <= joined_within)
                return false;
        return true;
    };
    return std::any_of(outer.borders.begin() + 1, outer.borders.end(), holds);
}

bool are_joined(const Patch& one, const Patch& other) {
    world::Box shared;
    shared.low = one.box.low.cwiseMax(other.box.low);
    shared.high = one.box.high.cwiseMin(other.box.high);
    if (((shared.low - shared.high).array() > joined_within).any())
        return false;
    const Eigen::Vector2d middle = (shared.low + shared.high) / 2;
    return std::abs(one.height->at(middle) - other.height->at(middle)) < joined_step &&
           distance_between(one.borders[0], other.borders[0]) <= joined_within &&
           !lies_in_a_hole(one, other) && !lies_in_a_hole(other, one);
}

/// Patches that are joined, as far as one must look to know that they are no splinter.
struct Island {
    std::vector<std::uint32_t> patches;
    bool at_crossing = false;
    Area area;
};

/// Of the strip with the same area and circumference. [m]
double mean_width(const Area& area) {
    double around = 0;
    for (const world::Loop& border : area.borders())
        for (std::size_t i = 0; i < border.size(); ++i)
            around += (border[(i + 1) % border.size()] - border[i]).norm();
    return around > 0 ? 2 * area.size() / around : 0;
}

class Finder {
  public:
    explicit Finder(const std::vector<Patch>& patches);

    std::vector<bool> find() const;

  private:
    Island island_of(std::uint32_t first) const;

    const std::vector<Patch>& patches_;
    world::BoxGrid by_place_;
};

Finder::Finder(const std::vector<Patch>& patches) : patches_(patches) {
    std::vector<world::BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        entries.push_back({patches[i].box, i});
    by_place_ = world::BoxGrid(entries);
}

Island Finder::island_of(std::uint32_t first) const {
    Island island{{first}, false, patches_[first].area->copy()};
    for (std::size_t i = 0; i < island.patches.size(); ++i) {
        const Patch& patch = patches_[island.patches[i]];
        island.at_crossing = island.at_crossing || patch.at_crossing;
        if (i > 0)
            island.area.merge(*patch.area);
        if (island.area.size() >= most_strip)
            break;
        world::Box reach = patch.box;
        reach.take(patch.box.low, joined_within);
        reach.take(patch.box.high, joined_within);
        for (const std::uint32_t other : by_place_.near(reach))
            if (std::find(island.patches.begin(), island.patches.end(), other) ==
                    island.patches.end() &&
                are_joined(patch, patches_[other]))
                island.patches.push_back(other);
    }
    return island;
}

std::vector<bool> Finder::find() const {
    std::vector<bool> splinters(patches_.size(), false);
    for (std::uint32_t i = 0; i < patches_.size(); ++i) {
        if (splinters[i] || patches_[i].area->size() >= most_strip)
            continue;
        const Island island = island_of(i);
        if (is_splinter(island.area, island.at_crossing))
            for (const std::uint32_t member : island.patches)
                splinters[member] = true;
    }
    return splinters;
}

}  // namespace

bool is_splinter(const Area& island, bool at_crossing) {
    const double size = island.size();
    return size < (at_crossing ? least_refuge : least_island) ||
           (size < most_strip && mean_width(island) < least_island_width);
}

double distance_between(const world::Loop& one, const world::Loop& other) {
    if (other.size() > 2 && world::contains(other, one[0]))
        return 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < other.size(); ++i)
        least = std::min(least, world::distance_to(one, other[i], other[(i + 1) % other.size()]));
    return least;
}

std::vector<bool> find_splinters(const std::vector<Patch>& patches) {
    return Finder(patches).find();
}

}  // namespace reprise::ground
