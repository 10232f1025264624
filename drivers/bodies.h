#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "drivers/control/ego.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/tick.h"
#include "world/units.h"

namespace reprise::drivers {

/// What somebody is to a driver who looks at them.
enum class BodyKind : std::uint8_t { vehicle, two_wheeler, walker, prop, door };

/// A footprint: an oriented box that moves.
struct Body {
    Eigen::Vector2d centre;
    Eigen::Vector2d direction;  ///< unit
    double z = 0;
    double half_length = 0;
    double half_width = 0;
    Eigen::Vector2d velocity;
    double speed = 0;
    double yaw_rate = 0;    ///< [rad/s] of driven vehicles, about the point that is next
    double axle_ahead = 0;  ///< [m] of the centre: where the rear axle is, below 0
    std::uint32_t id = 0;
    std::uint32_t lane = world::none;  ///< of SUMO's cars
    double lane_s = 0;                 ///< of the front bumper
    BodyKind kind = BodyKind::vehicle;
    /// A thing, a fallen walker, or a vehicle whose driver does not even brake, or has the hazard
    /// lights on: who stands so goes on standing.
    bool abandoned = false;

    double radius() const { return std::hypot(half_length, half_width); }

    /// Does the segment middle +- half touch the box?
    bool meets(const Eigen::Vector2d& middle, const Eigen::Vector2d& half) const;

    /// For who looks with segments across `ahead`, one every `step` [m]: what is thinner than that,
    /// as a cone or a post is, would lie between two of them. As long along `ahead` as a step then.
    Body seen_in_steps(const Eigen::Vector2d& ahead, double step) const;
};

inline bool has_hazard_lights(std::uint16_t lamps) {
    constexpr std::uint16_t both = world::lamp_left | world::lamp_right;
    return (lamps & both) == both;
}

/// All but `self` that may come within 10 m of `around` in the next `horizon` seconds, and every
/// open door: vehicles, cars, walkers, props, doors. What a car drives over is none.
void collect_bodies(const world::TickView& last,
                    std::uint32_t self,
                    const world::Box& around,
                    double horizon,
                    std::vector<Body>& bodies);

/// Would the front of the car touch somebody within `reach` [m], its wheels as they stand?
/// `slower_than` [m/s]: of those only.
bool something_is_before(const world::TickView& last,
                         const Ego& ego,
                         double reach,
                         double slower_than = world::infinity);

}  // namespace reprise::drivers
