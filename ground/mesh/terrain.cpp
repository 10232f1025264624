// Must: lie under everything; never stick up through a road; follow roads closely.
// Assumes: roads and slabs are triangles that face up, already in the mesh.
// Goes: every triangle pushes the corners of all grid cells that it touches below its own plane. A
//   cell's surface is linear between its corners, so it then lies below the triangle everywhere in
//   the cell, and where the road is one plane exactly terrain_depth below it. Under a bridge the
//   lower road wins; where there is none, the terrain carries the bridge like an embankment.
//   Corners that nothing touched take the mean of their neighbours, layer by layer outwards.
// Keeps: one height for each corner.
#include "ground/mesh/terrain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::ground {

namespace {

constexpr double border = 60.0;        ///< [m] beyond the last road
constexpr double hilly_border = 190;   ///< [m] and where it is not flat
constexpr double flat_cell = 32.0;     ///< [m]
constexpr double smallest_cell = 4.0;  ///< [m] in hilly towns
constexpr double most_cells = 60000;
constexpr double steepest = 0.35;  ///< slope; beyond it a triangle is a sliver, its plane noise
constexpr double unknown = std::numeric_limits<double>::infinity();

class Terrain {
  public:
    Terrain(const world::Box& box, double cell);

    void push_below(const std::array<Eigen::Vector3d, 3>& triangle, double depth);
    void fill_unknown();
    void add_to(GroundBuilder& ground) const;

  private:
    Eigen::Vector2d corner(std::size_t column, std::size_t row) const {
        return low_ +
               cell_ * Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row));
    }

    double& height(std::size_t column, std::size_t row) {
        return heights_[row * columns_ + column];
    }

    double mean_of_known_neighbours(std::size_t index) const;

    Eigen::Vector2d low_;
    double cell_;
    std::size_t columns_;  ///< of corners
    std::size_t rows_;
    std::vector<double> heights_;
};

Terrain::Terrain(const world::Box& box, double cell)
    : low_(box.low),
      cell_(cell),
      columns_(2 + static_cast<std::size_t>((box.high.x() - box.low.x()) / cell)),
      rows_(2 + static_cast<std::size_t>((box.high.y() - box.low.y()) / cell)),
      heights_(columns_ * rows_, unknown) {}

/// Does an axis-parallel square share a point with a triangle? Separating axes: the triangle's
/// three edges (the square's own are the caller's loop).
bool touches(const std::array<Eigen::Vector3d, 3>& triangle,
             const Eigen::Vector2d& low,
             double cell) {
    const Eigen::Vector2d middle = low + Eigen::Vector2d::Constant(cell / 2);
    for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector2d start = triangle[i].head<2>();
        const Eigen::Vector2d along = triangle[(i + 1) % 3].head<2>() - start;
        const double reach = (std::abs(along.x()) + std::abs(along.y())) * cell / 2;
        if (world::cross(along, middle - start) < -reach)
            return false;
    }
    return true;
}

void Terrain::push_below(const std::array<Eigen::Vector3d, 3>& triangle, double depth) {
    const Eigen::Vector3d normal =
        (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
    Eigen::Vector2d slope(-normal.x() / normal.z(), -normal.y() / normal.z());
    Eigen::Vector3d base = triangle[0];
    if (slope.norm() > steepest) {
        slope.setZero();
        base.z() = std::min({triangle[0].z(), triangle[1].z(), triangle[2].z()});
    }
    world::Box box;
    for (const Eigen::Vector3d& p : triangle)
        box.take(p.head<2>());
    const auto cell_index = [&](double offset) { return static_cast<std::size_t>(offset / cell_); };
    for (std::size_t row = cell_index(box.low.y() - low_.y());
         row <= cell_index(box.high.y() - low_.y());
         ++row)
        for (std::size_t column = cell_index(box.low.x() - low_.x());
             column <= cell_index(box.high.x() - low_.x());
             ++column) {
            if (!touches(triangle, corner(column, row), cell_))
                continue;
            for (const std::size_t c : {column, column + 1})
                for (const std::size_t r : {row, row + 1}) {
                    const Eigen::Vector2d away = corner(c, r) - base.head<2>();
                    height(c, r) = std::min(height(c, r), base.z() + slope.dot(away) - depth);
                }
        }
}

double Terrain::mean_of_known_neighbours(std::size_t index) const {
    const std::size_t column = index % columns_;
    const std::size_t row = index / columns_;
    double sum = 0;
    int count = 0;
    const auto take = [&](bool exists, std::size_t neighbour) {
        if (!exists || heights_[neighbour] == unknown)
            return;
        sum += heights_[neighbour];
        ++count;
    };
    take(column > 0, index - 1);
    take(column + 1 < columns_, index + 1);
    take(row > 0, index - columns_);
    take(row + 1 < rows_, index + columns_);
    return count > 0 ? sum / count : unknown;
}

void Terrain::fill_unknown() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < heights_.size(); ++i)
        if (heights_[i] == unknown)
            open.push_back(i);
    const std::vector<std::size_t> filled = open;
    // Layer by layer: a layer sees only the layers before it, so that no direction is preferred.
    while (!open.empty()) {
        std::vector<std::pair<std::size_t, double>> layer;
        std::vector<std::size_t> rest;
        for (const std::size_t index : open) {
            const double mean = mean_of_known_neighbours(index);
            if (mean == unknown)
                rest.push_back(index);
            else
                layer.emplace_back(index, mean);
        }
        if (layer.empty())
            return;
        for (const auto& [index, mean] : layer)
            heights_[index] = mean;
        open = std::move(rest);
    }
    // Then relaxed, so that no ridge stays where two layers met.
    for (int round = 0; round < 30; ++round)
        for (const std::size_t index : filled)
            heights_[index] = mean_of_known_neighbours(index);
}

void Terrain::add_to(GroundBuilder& ground) const {
    const auto p = [&](std::size_t column, std::size_t row) {
        const Eigen::Vector2d flat = corner(column, row);
        return Eigen::Vector3d(flat.x(), flat.y(), heights_[row * columns_ + column]);
    };
    for (std::size_t row = 0; row + 1 < rows_; ++row)
        for (std::size_t column = 0; column + 1 < columns_; ++column)
            ground.add_face(
                {p(column, row), p(column + 1, row), p(column + 1, row + 1), p(column, row + 1)},
                Surface::terrain);
}

bool is_mesh_flat(const GroundMesh& mesh) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.surfaces[i] != Surface::road)
            continue;
        for (const std::uint32_t vertex : mesh.triangles[i]) {
            low = std::min(low, mesh.vertices[vertex].z());
            high = std::max(high, mesh.vertices[vertex].z());
        }
    }
    return high - low < 1e-3;
}

/// What stands gets its height from hilly ground, so that it may not change that: all heights
/// depend on where the cells begin.
world::Box extent(const world::TownT& town, const GroundMesh& mesh, bool flat) {
    world::Box box;
    for (const Eigen::Vector3d& vertex : mesh.vertices)
        box.take(vertex.head<2>(), flat ? border : hilly_border);
    if (flat) {
        for (const world::Building& building : town.buildings)
            box.take(world::in_plan(building.centre()), border);
        for (const world::Tree& tree : town.trees)
            box.take(world::in_plan(tree.position()), border);
    }
    // Whole metres, and one to spare.
    box.low = box.low.array().floor() - 1;
    box.high = box.high.array().ceil() + 1;
    return box;
}

}  // namespace

void add_terrain(const world::TownT& town, GroundBuilder& ground) {
    const GroundMesh& mesh = ground.mesh();
    if (mesh.triangles.empty())
        return;
    const bool flat = is_mesh_flat(mesh);
    const world::Box box = extent(town, mesh, flat);
    const Eigen::Vector2d size = box.high - box.low;
    const double cell =
        flat ? flat_cell : std::max(smallest_cell, std::sqrt(size.prod() / most_cells));
    Terrain terrain(box, cell);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.surfaces[i] == Surface::kerb)
            continue;
        const auto& [p, q, r] = mesh.triangles[i];
        const double raised = mesh.surfaces[i] == Surface::sidewalk ? kerb_height : 0;
        terrain.push_below({mesh.vertices[p], mesh.vertices[q], mesh.vertices[r]},
                           raised + terrain_depth);
    }
    terrain.fill_unknown();
    terrain.add_to(ground);
}

}  // namespace reprise::ground
