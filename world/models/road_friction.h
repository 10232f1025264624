#pragma once

namespace reprise::world {

/// What is left of the grip on dry asphalt (Tick.road_friction) on other roads. A car's tyres have
/// 1.05 on dry asphalt (CarModel.grip), so these are 0.71, 0.35 and 0.09.
/// Wet: Mitschke/Wallentowitz, ch. 2. Snow (packed) and ice (bare, at -6 C): braked cars, F. Navin,
/// M. Macnabb and C. Nicolletti, "Vehicle Traction Experiments on Snow and Ice", SAE 960652, 1996.
inline constexpr double wet_friction = 0.68;
inline constexpr double snow_friction = 0.33;
inline constexpr double ice_friction = 0.09;

}  // namespace reprise::world
