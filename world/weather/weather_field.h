#pragma once

#include <span>
#include <string>
#include <string_view>

#include "world/common_generated.h"

namespace reprise::world {

/// One of a weather's numbers as people say it.
struct WeatherField {
    const char* key;    ///< with its unit where that is not SI: "rain_mm_h"
    const char* alias;  ///< shorter, for the command line: "rain"; or ""
    const char* unit;
    double low;
    double high;
    double scale;   ///< what one of the unit is in the weather; of a range: extinction x range
    bool is_range;  ///< said as how far one sees [m], kept as extinction [1/m]
    const char* meaning;  ///< one line
    float (Weather::*get)() const;
    void (Weather::*set)(float);

    bool is_named(std::string_view name) const { return name == key || (*alias && name == alias); }

    /// As the weather keeps it.
    float kept(double said) const {
        return static_cast<float>(is_range ? scale / said : said * scale);
    }

    double said(const Weather& weather) const {
        const auto value = static_cast<double>((weather.*get)());
        return is_range ? scale / value : value / scale;
    }
};

/// Those of old first. Some numbers have two rows: cloud_cover and okta.
std::span<const WeatherField> weather_fields();

/// By key or alias; null when there is none.
const WeatherField* find_weather_field(std::string_view name);

}  // namespace reprise::world
