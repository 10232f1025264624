#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "render/shapes/material.h"

namespace reprise::render {

/// Triangles, counter-clockwise seen from outside. Metres.
struct Mesh {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Material> materials;                      ///< one for each triangle
    std::vector<std::uint32_t> tags;                      ///< likewise, see Material
    std::vector<std::array<Eigen::Vector3f, 3>> normals;  ///< of the corners; empty: flat
};

/// Gives what is added a material and a tag.
struct Finish {
    Material material;
    std::uint32_t tag = 0;
};

std::uint32_t add_vertex(Mesh& mesh, const Eigen::Vector3f& position);
void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, Finish finish);

/// Corners counter-clockwise seen from outside.
void add_quad(Mesh& mesh, const std::array<Eigen::Vector3f, 4>& corners, Finish finish);

/// Sides of a box, to be joined: those that lie in a wall or on another box are best left out, as
/// each is two triangles that no ray meets.
namespace box_side {

inline constexpr unsigned low_x = 1, high_x = 2, low_y = 4, high_y = 8, low_z = 16, high_z = 32;

}  // namespace box_side

/// A box around the pose's origin with these half sizes, but for its sides `without`.
void add_box(Mesh& mesh,
             const Eigen::Isometry3f& pose,
             const Eigen::Vector3f& half,
             Finish finish,
             unsigned without = 0);

/// A cone stump with closed ends.
struct Tube {
    Eigen::Vector3f from;
    Eigen::Vector3f to;
    float radius_from;
    float radius_to;
    int sides = 12;
};

void add_tube(Mesh& mesh, const Tube& tube, Finish finish);

/// Rows of rings: ring[i][j] to ring[i+1][j]. `closed` joins the last point of a ring to its first.
/// Outside is where j grows counter-clockwise when looking against the direction of growing i.
void add_loft(Mesh& mesh,
              const std::vector<std::vector<Eigen::Vector3f>>& rings,
              bool closed,
              Finish finish);

void add_ellipsoid(Mesh& mesh,
                   const Eigen::Vector3f& centre,
                   const Eigen::Vector3f& radii,
                   int segments,
                   Finish finish);

/// Corner normals, averaged over the triangles at a vertex that lean less than `crease` away. [rad]
void smooth(Mesh& mesh, double crease);

/// `mesh` of flat triangles, with those of `part` behind its own.
void append(Mesh& mesh, const Mesh& part);

/// Embree builds poor trees over triangles without area, and their normals are not numbers.
void drop_degenerate(Mesh& mesh);

}  // namespace reprise::render
