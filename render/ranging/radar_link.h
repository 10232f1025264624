#pragma once

namespace reprise::render {

// The way of a radar's power at 77 GHz, from a transmitter of 12 dBm through an antenna of 24 dBi,
// to a receiver with 12 dB of noise figure and 15 dB of losses, which adds up 20 ms of chirps. A
// car of 10 m^2 is noticed up to 450 m in clear air.

/// What the receiver makes of a target of `cross_section` [m^2] at `range` [m], as a ratio to its
/// noise. `gain`: of the antenna there, of that straight ahead; `loss` [dB/km] of the air, one way.
double signal_to_noise(double cross_section, double range, double gain, double loss);

/// Of the antenna at an angle off its axis, where `fov` is the angle between the directions with
/// half of the power. Gaussian. [rad]
double antenna_gain(double angle, double fov);

/// What rain of so many mm/h takes: ITU-R P.838-3 at 77 GHz. [dB/km]
double rain_loss(double mm_per_hour);

/// Ratios from here on are detections: 13 dB.
inline constexpr double detection_ratio = 20;

}  // namespace reprise::render
