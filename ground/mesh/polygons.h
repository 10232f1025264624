#pragma once

#include <memory>
#include <vector>

#include "world/geometry2d.h"

namespace reprise::ground {

/// A region in plan, for unions and differences of whatever road networks hold: shapes may be
/// concave, cross themselves, repeat points or have no area. Computed on whole millimetres (integer
/// sweep, Boost.Polygon), so the result is the same on every machine and never fails.
/// A shape that crosses itself holds what it winds around, whichever way.
class Area {
  public:
    Area();
    ~Area();
    Area(Area&&) noexcept;
    Area& operator=(Area&&) noexcept;

    /// Coordinates are kept relative to `origin` while computing; within 1000 km of it.
    explicit Area(const Eigen::Vector2d& origin);

    Area copy() const;

    void add(const world::Loop& loop);
    void merge(const Area& other);  ///< as below, of the same origin
    void subtract(const Area& other);
    void intersect(const Area& other);

    /// Takes a strip of this width off along every border. [m]
    void shrink(double width);

    double size() const;  ///< [m2]

    /// Triangles, counter-clockwise, that meet without cracks: their corners are the borders' own.
    std::vector<world::Loop> pieces() const;

    /// Borders with the area on their left: outer ones counter-clockwise, holes clockwise.
    std::vector<world::Loop> borders() const;

    /// Its connected parts, with their holes. None is empty.
    std::vector<Area> parts() const;

  private:
    struct Set;
    std::unique_ptr<Set> set_;
};

}  // namespace reprise::ground
