#pragma once

#include <optional>
#include <string>
#include <vector>

#include "world/tick.h"
#include "world/weather/weather_course.h"

namespace reprise::cli {

/// Under which weather a run is looked at: one that somebody says, or as it was recorded.
class ChosenWeather {
  public:
    /// "" and "recorded": as recorded, tick by tick; "recorded,rain=5": so, but for these numbers;
    /// else what world::WeatherCourse takes. `step`: [s] of a tick. Throws world::Error.
    ChosenWeather(const std::string& text, double step);

    world::Weather at(const world::TickView& tick) const;

    /// Nothing: as recorded, but for changes().
    const std::optional<world::WeatherCourse>& course() const { return course_; }

    /// Of what was recorded. Empty: none.
    const std::string& changes() const { return changes_; }

  private:
    std::optional<world::WeatherCourse> course_;
    std::string changes_;
    double step_;
};

/// The weathers of a list, by their texts: "clear_noon,cloudy_noon,snow=1,recorded" are three, as
/// changes belong to what they follow; "all18" is the eighteen of CARLA's paper. With timelines
/// among them they are parted by ';'. Throws world::Error, also where one is there twice.
std::vector<std::string> weather_list(const std::string& text);

}  // namespace reprise::cli
