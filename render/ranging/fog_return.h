#pragma once

#include <vector>

namespace reprise::render {

/// What fog itself sends back, beside what it swallows: after Rasshofer, Spies and Spies (2011) and
/// Hahner et al. ("Fog Simulation on Real LiDAR Point Clouds", ICCV 2021). A pulse sin^2 of 20 ns
/// meets droplets all along its way; the receiver takes the strongest instant for a target.
/// Powers count as those of Pulse: Hahner's soft target against a hard one that is white.
class FogReturn {
  public:
    /// `extinction` of the fog [1/m]; 0: none.
    explicit FogReturn(double extinction);

    struct Peak {
        double range = 0;  ///< [m] where the receiver believes a target
        double power = 0;
    };

    /// Of fog before a surface so far away. [m]; infinity: no surface. O(1).
    Peak before(double range) const;

  private:
    std::vector<Peak> peaks_;  ///< by multiples of a step; the last is that of all fog
};

/// Koschmieder's law: the distance at which 5 % of the contrast are left. [m] for [1/m]
double visibility_of(double extinction);

}  // namespace reprise::render
