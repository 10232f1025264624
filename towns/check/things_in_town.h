#pragma once

#include <string>
#include <vector>

#include "ground/swept_area.h"
#include "world/geometry2d.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// What is taken as the radius of a pole's foot. [m]
inline constexpr double pole_radius = 0.15;

/// Everything that stands in a town, by place: buildings, plants, furniture, signal heads.
class ThingsInTown {
  public:
    struct Thing {
        std::string name;   ///< "building 12"
        world::Loop loop;   ///< seen from above; one point: round
        double radius = 0;  ///< [m] around the loop
        double low = 0;     ///< [m] world
        double high = 0;
    };

    explicit ThingsInTown(const world::TownT& town);

    std::size_t size() const { return things_.size(); }

    /// Calls `visit(thing)` for all that stands nearer than `clear` [m] to a segment of a way.
    template <typename Visit>
    void for_each_on(const world::Vec3& from,
                     const world::Vec3& to,
                     double clear,
                     Visit&& visit) const {
        world::Box box;
        box.take(world::in_plan(from), clear);
        box.take(world::in_plan(to), clear);
        for (const std::uint32_t i : by_place_.near(box))
            if (is_on_level(things_[i], std::min(from.z(), to.z())) &&
                world::distance_to(things_[i].loop, world::in_plan(from), world::in_plan(to)) -
                        things_[i].radius <
                    clear)
                visit(things_[i]);
    }

    /// And for all that stands in a body's way, more than `tolerance` [m] deep.
    template <typename Visit>
    void for_each_in(const ground::SweptBody& body, double tolerance, Visit&& visit) const {
        const world::Loop loop = body.corners(tolerance);
        for (const std::uint32_t i : by_place_.near(world::box_around(loop)))
            if (is_on_level(things_[i], body.z) && touch(things_[i], loop))
                visit(things_[i]);
    }

  private:
    static bool is_on_level(const Thing& thing, double road);
    static bool touch(const Thing& thing, const world::Loop& loop);

    std::vector<Thing> things_;
    world::BoxGrid by_place_;
};

}  // namespace reprise::towns
