#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "traffic/cars/cars.h"
#include "traffic/sight/obstructions.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Around what blocks each lane of its direction: through the oncoming one.
///
/// MUST    begin only where the oncoming lane is free for as long as it takes, and where there is
///         room to come back before the lane ends.
/// ASSUMES that a car goes aside as it drives (see CarReader), SUMO having it in its own lane all
///         the while, and that others see a car that is aside (see footprints.h).
/// GOES    who has stood for some seconds, first behind the thing, is told to drive aside by a
///         lane's width, and behind the thing to come back; slowly, where it stands so close that
///         a corner would touch the thing otherwise, and not at all where it would even so. Where
///         there is a lane beside its own, which may get free (PullingOut), it has more patience.
/// KEEPS   nothing beside the cars.
class Passing {
  public:
    static constexpr double speed = 5;  ///< [m/s] of one who passes

    /// All of them must outlive this. `step` [s] of a tick.
    Passing(const world::TownT& town, const Obstructions& obstructions, double step)
        : town_(&town),
          obstructions_(&obstructions),
          step_(step) {}

    /// A car that is held back and stands begins to pass, where it may.
    void begin(Car& car, const Cars& cars, const world::TickView& last, std::uint64_t tick) const;

    /// [m/s] of a car that passes.
    static double allowed_speed(const Car& car);

    /// Tells a car that passes to come back, behind what it passed.
    void follow(Car& car, std::uint64_t tick) const;

  private:
    struct Stretch;

    std::optional<double> end_of_row(const Car& car, double front, double aside) const;
    bool is_free(const Stretch& stretch,
                 const Car& car,
                 const Cars& cars,
                 const world::TickView& last) const;

    const world::TownT* town_;
    const Obstructions* obstructions_;
    double step_;
};

}  // namespace reprise::traffic
