#pragma once

#include <optional>
#include <string>
#include <vector>

#include "world/common_generated.h"
#include "world/weather/weather.h"

namespace reprise::world {

/// A weather that is reached at a time of the run.
struct WeatherStop {
    double at = 0;  ///< [s]
    WeatherPreset said;
};

/// A weather over the time of a run, as `render --weather` says it: "hard_rain_sunset", or stops
/// with times, "0s:clear_noon,30s:rain=20,fog=300,45s:cloudy_sunset". Numbers alone change the
/// weather of the stop before. Before the first stop it is as there, behind the last one likewise,
/// between two each physical number goes evenly.
class WeatherCourse {
  public:
    /// Throws Error in one line.
    explicit WeatherCourse(const std::string& text);

    Weather at(double seconds) const;

    /// As it was said.
    const std::string& name() const { return name_; }

    const std::vector<WeatherStop>& stops() const { return stops_; }

  private:
    std::string name_;
    std::vector<WeatherStop> stops_;  ///< at least one, by time
};

/// Of "recorded,rain=5,fog=300" the changes to what a run recorded: "rain=5,fog=300", which
/// read_weather() takes upon each tick's weather. Empty of "recorded" itself; nothing of any other
/// text. Throws Error where what follows is no change.
std::optional<std::string> changes_of_recorded(const std::string& text);

}  // namespace reprise::world
