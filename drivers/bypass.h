#pragma once

#include "drivers/control/lateral_order.h"
#include "world/digest.h"

namespace reprise::drivers {

/// A way around something: aside from the path, on beside it, and back. Along the path, of the
/// point of the car that is steered along it (tracked_ahead). Quintic steps: no jump in heading or
/// curvature. [m]
struct Bypass {
    double out_start = 0;
    double out_end = 0;
    double back_start = 0;
    double back_end = 0;
    double from = 0;    ///< left of the path, before
    double aside = 0;   ///< left of the path, beside what is passed
    double behind = 0;  ///< left of the path, behind it

    /// The least length of a step of `width` metres aside that is bent by no more than that. [1/m]
    static double shortest_step(double width, double sharpest);

    /// The greatest speed on a step so long, for so much to the side. [m/s], [m/s^2]
    static double fastest(double width, double length, double lateral_acceleration);

    /// [m] left of the path.
    double offset(double s) const;

    /// For the place s. `soon`: s when the wheels will have turned.
    BesidePath beside(double s, double soon) const;

    /// The path is counted from elsewhere: s grows by so much.
    void shift(double distance);

    void add_to(world::Hasher& hasher) const;
};

}  // namespace reprise::drivers
