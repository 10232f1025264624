#pragma once

#include <cstdint>

#include "world/tick_generated.h"

namespace reprise::world {

/// A quantity that goes from one value to another: what OpenSCENARIO calls TransitionDynamics. It
/// stays where it arrived.
struct Transition {
    double from = 0;
    double to = 0;
    double duration = 0;  ///< [s] of the whole change; 0: at once
    Shape shape = Shape::linear;
    double corner = 0;  ///< [s] in which a linear one comes to its rate, and again leaves it

    /// So many seconds after it began.
    double value(double seconds) const;
    double rate(double seconds) const;          ///< [1/s]; 0 before it begins and when it is done
    double acceleration(double seconds) const;  ///< [1/s^2] likewise
};

/// Of a change by 1 in 1 s: the fastest rate that there is on the way. `step` is taken for
/// sinusoidal, which is how it is driven, as quickly as that goes.
double fastest_rate(Shape shape);

/// Likewise the largest acceleration; linear ones have corners instead: infinity.
double largest_acceleration(Shape shape);

}  // namespace reprise::world
