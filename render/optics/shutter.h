#pragma once

#include <vector>

#include <Eigen/Core>

#include "world/external/sensor.h"

namespace reprise::render {

/// Rows that are seen at one instant.
struct Band {
    int first = 0;
    int rows = 0;
    double ago = 0;  ///< [s] before the tick
};

/// When and through what a camera sees, from its attributes. All is over at the tick's instant:
/// what comes after it a live camera could not know.
struct Shutter {
    explicit Shutter(const world::SensorSpec& spec);

    /// Whether a picture is the mean of several.
    bool blurs() const { return samples > 1; }

    /// [s] before the end of its exposure that a sample is of.
    double ago(int sample) const { return open * (sample + 0.5) / samples; }

    /// Where in the lens's opening a sample is taken. [m] right and down of its middle
    Eigen::Vector2d aside(int sample) const;

    double readout = 0;   ///< [s] in which the rows are read, the lowest last
    double open = 0;      ///< [s] that each row sees; 0: an instant
    double sharp = 0;     ///< [m] away; 0: everything is
    double aperture = 0;  ///< [m] radius of the opening
    int samples = 1;
};

/// The rows of a picture, from the top: one band where all are read at once, else bands of half a
/// millisecond, or of eight rows.
std::vector<Band> bands_of(const world::SensorSpec& spec);

}  // namespace reprise::render
