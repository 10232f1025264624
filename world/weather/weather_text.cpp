#include "world/weather/weather_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "world/check.h"
#include "world/weather/carla_weather.h"
#include "world/weather/weather_field.h"

namespace reprise::world {

namespace {

/// KEY=VALUE.
struct Said {
    std::string key;
    double value = 0;
};

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char letter : text) {
        if (letter == ',')
            parts.emplace_back();
        else
            parts.back() += letter;
    }
    return parts;
}

Said read_change(const std::string& part) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0)
        throw Error(fmt::format("expected KEY=VALUE such as rain=8, got '{}'", part));
    Said said{part.substr(0, equals), 0};
    const char* end = part.data() + part.size();
    const auto [stop, error] = std::from_chars(part.data() + equals + 1, end, said.value);
    if (error != std::errc() || stop != end || !std::isfinite(said.value))
        throw Error(fmt::format("'{}': expected a number such as 8 or 0.5, got '{}'",
                                said.key,
                                part.substr(equals + 1)));
    return said;
}

/// Small, and without '_': names are written together or apart.
std::string letters_of(const std::string& name) {
    std::string letters;
    for (const char sign : name)
        if (sign != '_')
            letters += sign >= 'A' && sign <= 'Z' ? static_cast<char>(sign - 'A' + 'a') : sign;
    return letters;
}

/// A number without its value; or the nearest name, or else the first that begins so: 'hard_rain'
/// is that of noon.
std::string hint(const std::string& text, const std::vector<std::string>& names) {
    if (const WeatherField* field = find_weather_field(text)) {
        for (const double value : {8.0, 0.5, 200.0})
            if (value >= field->low && value <= field->high)
                return fmt::format(" (did you mean '{}={}'?)", text, value);
    }
    if (std::string near = did_you_mean(text, names); !near.empty() || text.size() < 3)
        return near;
    const std::string letters = letters_of(text);
    for (const std::string& name : names)
        if (letters_of(name).compare(0, letters.size(), letters) == 0)
            return " (did you mean '" + name + "'?)";
    return "";
}

[[noreturn]] void refuse_key(const std::string& key, const std::vector<std::string>& known) {
    throw Error(fmt::format(
        "no number '{}'{}; there are {}", key, did_you_mean(key, known), fmt::join(known, ", ")));
}

[[noreturn]] void refuse_twice(const std::string& key) {
    throw Error(fmt::format("'{}' says a number that was said already", key));
}

/// On top of a preset of CARLA's, by CARLA's keys.
Weather changed_as_carla(CarlaWeather carla, const std::vector<Said>& changes) {
    const std::vector<std::string> known(carla_weather_keys.begin(), carla_weather_keys.end());
    std::array<bool, carla_weather_keys.size()> seen{};
    for (const Said& said : changes) {
        const auto found = std::find(known.begin(), known.end(), said.key);
        if (found == known.end())
            refuse_key(said.key, known);
        const auto key = static_cast<std::size_t>(found - known.begin());
        if (const std::string trouble = trouble_with(key, said.value); !trouble.empty())
            throw Error(trouble);
        if (seen[key])
            refuse_twice(said.key);
        seen[key] = true;
        carla[key] = said.value;
    }
    return weather_of(carla);
}

/// What a steady rain or snowfall brings with it; never less than there was.
void bring_along(Weather& weather, const std::vector<const WeatherField*>& said) {
    const auto raise =
        [&](float (Weather::*get)() const, void (Weather::*set)(float), float least) {
            const bool open = std::none_of(said.begin(), said.end(), [&](const WeatherField* each) {
                return each->get == get;
            });
            if (open)
                (weather.*set)(std::max((weather.*get)(), least));
        };
    const float falling = weather.rain() + weather.snow();
    raise(&Weather::cloud_cover, &Weather::mutate_cloud_cover, 0.9F * falling / (falling + 0.5F));
    raise(&Weather::wetness, &Weather::mutate_wetness, weather.rain() / (weather.rain() + 1));
    raise(
        &Weather::puddles, &Weather::mutate_puddles, 0.8F * weather.rain() / (weather.rain() + 15));
    raise(&Weather::snow_cover, &Weather::mutate_snow_cover, weather.snow() / (weather.snow() + 1));
}

Weather changed(Weather weather, const std::vector<Said>& changes) {
    std::vector<const WeatherField*> seen;
    for (const Said& said : changes) {
        const WeatherField* field = find_weather_field(said.key);
        if (field == nullptr) {
            std::vector<std::string> known;
            for (const WeatherField& each : weather_fields())
                known.emplace_back(*each.alias != 0 ? each.alias : each.key);
            refuse_key(said.key, known);
        }
        if (!(said.value >= field->low && said.value <= field->high))
            throw Error(fmt::format("'{}' must be in [{}, {}]{}{}, got {}",
                                    said.key,
                                    field->low,
                                    field->high,
                                    *field->unit != 0 ? " " : "",
                                    field->unit,
                                    said.value));
        for (const WeatherField* earlier : seen)
            if (earlier->get == field->get)
                refuse_twice(said.key);
        seen.push_back(field);
        (weather.*field->set)(field->kept(said.value));
    }
    bring_along(weather, seen);
    return weather;
}

}  // namespace

WeatherPreset read_weather(const std::string& text) {
    return read_weather(text, find_weather("clear_noon")->weather);
}

WeatherPreset read_weather(const std::string& text, const Weather& before) {
    if (const WeatherPreset* preset = find_weather(text))
        return *preset;
    std::vector<std::string> parts = split(text);
    const bool has_base = parts.front().find('=') == std::string::npos;
    const std::string base = has_base ? parts.front() : "";
    if (has_base)
        parts.erase(parts.begin());
    std::vector<std::string> names = weather_names();
    names.emplace_back("carla");
    if (has_base && std::find(names.begin(), names.end(), base) == names.end())
        throw Error(fmt::format(
            "no weather '{}'{}; reprise list weathers shows them all", base, hint(base, names)));
    std::vector<Said> changes;
    for (const std::string& part : parts)
        changes.push_back(read_change(part));
    const std::string carla_base = base == "carla" ? "Default" : base;
    for (const CarlaPreset& preset : carla_presets())
        if (preset.name == carla_base) {
            const Weather weather = changed_as_carla(preset.weather, changes);
            return {text, weather, road_friction_in(weather), "CARLA"};
        }
    const Weather weather = changed(has_base ? find_weather(base)->weather : before, changes);
    return {text, weather, road_friction_in(weather), "own"};
}

std::optional<WeatherPreset> weather_of_text(const std::string& text) {
    try {
        return read_weather(text);
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace reprise::world
