#pragma once

#include <cstdint>
#include <vector>

#include "ground/mesh/polygons.h"
#include "world/geometry2d.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// The strips that all lanes take up, and what buses sweep over beside them, seen from above, found
/// by place. Borrows the town.
class LaneStrips {
  public:
    explicit LaneStrips(const world::TownT& roads);

    /// Around all lanes. [m]
    world::Box box(double margin) const;

    /// Does a lane come within this distance of the loop, sideways or along? By boxes. [m]
    bool is_near(const world::Loop& loop, double distance) const;

    /// The lanes that come near the loop, each as wide as it is and a little more; and the buses.
    ground::Area around(const world::Loop& loop, const Eigen::Vector2d& origin) const;

  private:
    std::vector<std::uint32_t> touching(const world::Box& box) const;

    const world::TownT& roads_;
    std::vector<world::Box> boxes_;  ///< [lane]
    world::BoxGrid grid_;
    std::vector<world::Loop> buses_;
    world::BoxGrid bus_grid_;
};

}  // namespace reprise::towns
