#pragma once

#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/ray_grid.h"

namespace reprise::kernel {

/// The ground beyond a mesh. Every town ends somewhere; who drives on would fall for ever. So from
/// the border of the mesh's rectangle outwards the ground goes on level, as high as the border is
/// at its nearest point. Nobody sees it, and within the rectangle nothing of it is there.
class Outskirts {
  public:
    /// [m] to all sides: farther than anybody gets.
    static constexpr double reach = 1e5;

    /// `low` and `high` bound the mesh; `rays` finds its triangles and must outlive this.
    Outskirts(const btVector3& low, const btVector3& high, const RayGrid& rays)
        : low_(low),
          high_(high),
          rays_(&rays) {}

    /// In plan.
    bool hold(const btVector3& p) const {
        return p.x() < low_.x() || p.x() > high_.x() || p.y() < low_.y() || p.y() > high_.y();
    }

    /// Of the ground there; asked only beyond the rectangle.
    double height(const btVector3& p) const;

    /// Two triangles for each side over which these bounds reach.
    void offer(btTriangleCallback& callback, const btVector3& low, const btVector3& high) const;

  private:
    void offer_level(
        btTriangleCallback& callback, double from_x, double to_x, double from_y, double to_y) const;

    btVector3 low_;
    btVector3 high_;
    const RayGrid* rays_;
};

}  // namespace reprise::kernel
