#pragma once

#include <optional>
#include <string>

#include "world/weather/weather.h"

namespace reprise::world {

/// What `--weather` says: a preset, a preset with changes, or numbers alone upon clear_noon, such
/// as "hard_rain_sunset", "cloudy_noon,fog=300", "rain=30,fog=200,sun_altitude=8". What goes with a
/// number and is not said itself follows: rain brings clouds and wets the road, snow lies, and the
/// road's grip is that of the weather. After a preset of CARLA's, or the word carla, the keys are
/// CARLA's: "ClearNoon,precipitation=60", "carla,cloudiness=80,fog_density=30".
/// Throws Error in one line. The preset's name is the text.
WeatherPreset read_weather(const std::string& text);

/// The same where numbers alone change `before`, not clear_noon.
WeatherPreset read_weather(const std::string& text, const Weather& before);

/// The same, or none where the text says no weather: of names that traces carry.
std::optional<WeatherPreset> weather_of_text(const std::string& text);

}  // namespace reprise::world
