#pragma once

#include <cstdint>
#include <optional>

#include "world/digest.h"
#include "world/models/car_model.h"
#include "world/transition.h"

namespace reprise::drivers {

/// Where beside its path the car is to drive at one place, and how that goes on. Left is positive.
struct BesidePath {
    /// [s] of bend_soon: a tick's delay, the wheels' turning, and the tyres' answer to it
    static constexpr double preview = 0.15;

    double offset = 0;     ///< [m]
    double slope = 0;      ///< offset per metre driven
    double bend = 0;       ///< slope per metre driven [1/m]
    double bend_soon = 0;  ///< when the wheels will have turned
};

/// What a scenario told a driver about its place beside the middle of its lane: an offset that it
/// keeps, and changes of it over a time. A change of lanes within a time is one, too: from where
/// the car is to the middle of the other lane, which is its path from then on.
class LateralOrder {
  public:
    /// To keep from now on. Without a duration as the driver likes, with the shape `step` as
    /// quickly as the grip allows.
    void set_offset(double offset, double duration, world::Shape shape);

    /// From wherever the car is now, beside a path that has become another one.
    void come_over(double duration, world::Shape shape);

    /// What was said since the last tick begins `beside` metres left of the path. [m/s], friction
    /// as in the tick.
    void begin(std::uint64_t tick,
               double beside,
               const world::CarModel& car,
               double speed,
               double road_friction);

    /// Nothing to do with it: in the middle of the path, for good.
    bool empty() const { return !is_new_ && kept_ == 0 && !changes_; }

    /// Of a change: 1 to the left, -1 to the right, 0: there is none.
    int side(std::uint64_t tick, double step) const;

    /// [m] left of the path at this tick, and `later` seconds after it.
    double offset(std::uint64_t tick, double step, double later = 0) const;

    /// For the place `ahead` [m] of the rear axle, which is to run on the line; none when empty.
    std::optional<BesidePath> beside(std::uint64_t tick,
                                     double step,
                                     double speed,
                                     double ahead) const;

    /// A change that is done is forgotten.
    void end(std::uint64_t tick, double step);

    void add_to(world::Hasher& hasher) const;

  private:
    double seconds(std::uint64_t tick, double step) const;

    double kept_ = 0;  ///< [m] behind the change
    bool is_new_ = false;
    bool changes_ = false;
    world::Transition change_;
    std::uint64_t start_ = 0;  ///< tick
};

}  // namespace reprise::drivers
