// Must: find every splinter of sidewalk, by measuring, not by trusting how the mesh was made.
// Assumes: neighbouring pieces of a sidewalk touch or overlap.
// Goes: sidewalk triangles that lie within joined_within of each other, at the same height, are one
//   island; the size of an island is that of its union.
#include "towns/check/island_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "ground/mesh/splinters.h"

namespace reprise::towns {

namespace {

constexpr double level = 0.25;   ///< [m] what lies farther above or below is not joined
constexpr double plenty = 50.0;  ///< [m2] of triangles, some of which may lie on each other

world::Loop in_plan(const ground::GroundMesh& ground, std::uint32_t triangle) {
    world::Loop corners;
    for (const std::uint32_t vertex : ground.triangles[triangle])
        corners.push_back(ground.vertices[vertex].head<2>());
    return corners;
}

/// The islands of a mesh, as sets that grow together.
class Islands {
  public:
    Islands(const ground::GroundMesh& ground, const ground::GroundProbe& probe);

    /// Triangles of each, by the lowest of them.
    std::map<std::uint32_t, std::vector<std::uint32_t>> sets() const;

    bool is_at_crossing(const std::vector<std::uint32_t>& island) const;

    ground::Area area_of(const std::vector<std::uint32_t>& island) const;

  private:
    std::uint32_t root(std::uint32_t triangle) const;
    bool touch(std::uint32_t one, std::uint32_t other) const;

    const ground::GroundMesh& ground_;
    const ground::GroundProbe& probe_;
    std::vector<std::uint32_t> above_;  ///< [triangle] another one of its set, or itself
};

Islands::Islands(const ground::GroundMesh& ground, const ground::GroundProbe& probe)
    : ground_(ground),
      probe_(probe),
      above_(ground.triangles.size()) {
    std::iota(above_.begin(), above_.end(), 0u);
    for (std::uint32_t i = 0; i < above_.size(); ++i) {
        if (ground.surfaces[i] != ground::Surface::sidewalk)
            continue;
        for (const std::uint32_t other :
             probe.near(world::box_around(in_plan(ground, i), ground::joined_within)))
            if (other < i && ground.surfaces[other] == ground::Surface::sidewalk &&
                root(other) != root(i) && touch(i, other)) {
                const auto [low, high] = std::minmax({root(other), root(i)});
                above_[high] = low;
            }
        above_[i] = root(i);
    }
}

std::uint32_t Islands::root(std::uint32_t triangle) const {
    while (above_[triangle] != triangle)
        triangle = above_[triangle];
    return triangle;
}

bool Islands::touch(std::uint32_t one, std::uint32_t other) const {
    const auto heights = [&](std::uint32_t triangle) {
        std::array<double, 3> z{};
        for (std::size_t i = 0; i < 3; ++i)
            z[i] = ground_.vertices[ground_.triangles[triangle][i]].z();
        return std::minmax({z[0], z[1], z[2]});
    };
    const auto [low, high] = heights(one);
    const auto [other_low, other_high] = heights(other);
    return other_low < high + level && low < other_high + level &&
           ground::distance_between(in_plan(ground_, one), in_plan(ground_, other)) <=
               ground::joined_within;
}

std::map<std::uint32_t, std::vector<std::uint32_t>> Islands::sets() const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> sets;
    for (std::uint32_t i = 0; i < above_.size(); ++i)
        if (ground_.surfaces[i] == ground::Surface::sidewalk)
            sets[root(i)].push_back(i);
    return sets;
}

/// Crossings lie a kerb lower than the islands beside them.
bool Islands::is_at_crossing(const std::vector<std::uint32_t>& island) const {
    return std::any_of(island.begin(), island.end(), [&](std::uint32_t triangle) {
        const world::Box box = world::box_around(in_plan(ground_, triangle), ground::joined_within);
        const std::vector<std::uint32_t> near = probe_.near(box);
        return std::any_of(near.begin(), near.end(), [&](std::uint32_t other) {
            return ground_.surfaces[other] == ground::Surface::crossing && touch(triangle, other);
        });
    });
}

ground::Area Islands::area_of(const std::vector<std::uint32_t>& island) const {
    const Eigen::Vector2d first = in_plan(ground_, island[0])[0];
    ground::Area area(Eigen::Vector2d(std::floor(first.x()), std::floor(first.y())));
    for (const std::uint32_t triangle : island)
        area.add(in_plan(ground_, triangle));
    return area;
}

double size_of_triangles(const ground::GroundMesh& ground,
                         const std::vector<std::uint32_t>& island) {
    double size = 0;
    for (const std::uint32_t triangle : island)
        size += std::abs(world::signed_area(in_plan(ground, triangle)));
    return size;
}

}  // namespace

Criterion check_islands(const ground::GroundMesh& ground, const ground::GroundProbe& probe) {
    const Islands islands(ground, probe);
    const auto sets = islands.sets();
    std::vector<Criterion::Place> faults;
    for (const auto& [first, island] : sets) {
        if (size_of_triangles(ground, island) > plenty)
            continue;
        const ground::Area area = islands.area_of(island);
        if (!ground::is_splinter(area, islands.is_at_crossing(island)))
            continue;
        const std::string size = std::to_string(std::lround(area.size() * 100));  // [dm2]
        faults.push_back({size + " dm2 of sidewalk", in_plan(ground, first)[0], 1});
    }
    return none_of("splinters of sidewalk",
                   std::move(faults),
                   std::to_string(sets.size()) + " islands of sidewalk");
}

}  // namespace reprise::towns
