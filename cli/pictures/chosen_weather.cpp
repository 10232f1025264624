#include "cli/pictures/chosen_weather.h"

#include <algorithm>
#include <string_view>

#include "world/check.h"
#include "world/weather/weather_text.h"

namespace reprise::cli {

namespace {

std::vector<std::string> parted(const std::string& text, char by) {
    std::vector<std::string> parts(1);
    for (const char letter : text)
        if (letter == by)
            parts.emplace_back();
        else
            parts.back() += letter;
    return parts;
}

void add(std::vector<std::string>& list, const std::string& weather) {
    if (weather == "all18") {
        for (const world::WeatherPreset& preset : world::weather_presets())
            if (std::string_view(preset.source) == "paper" && !preset.name.ends_with("_night"))
                list.push_back(preset.name);
        return;
    }
    if (!world::changes_of_recorded(weather))
        world::WeatherCourse{weather};  // throws where it is none
    list.push_back(weather);
}

}  // namespace

ChosenWeather::ChosenWeather(const std::string& text, double step) : step_(step) {
    if (const auto changes = world::changes_of_recorded(text))
        changes_ = *changes;
    else if (!text.empty())
        course_.emplace(text);
}

world::Weather ChosenWeather::at(const world::TickView& tick) const {
    if (course_)
        return course_->at(static_cast<double>(tick.index()) * step_);
    const world::Weather& recorded = *tick.tick->weather();
    return changes_.empty() ? recorded : world::read_weather(changes_, recorded).weather;
}

std::vector<std::string> weather_list(const std::string& text) {
    std::vector<std::string> said;
    if (text.find(';') != std::string::npos || text.find(':') != std::string::npos) {
        said = parted(text, ';');
    } else {
        for (const std::string& part : parted(text, ','))
            if (!said.empty() && part.find('=') != std::string::npos)
                said.back() += "," + part;
            else
                said.push_back(part);
    }
    std::vector<std::string> list;
    for (const std::string& weather : said)
        add(list, weather);
    for (std::size_t i = 0; i < list.size(); ++i)
        if (std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), list[i]) !=
            list.begin() + static_cast<std::ptrdiff_t>(i))
            throw world::Error("the weather '" + list[i] + "' is there twice");
    return list;
}

}  // namespace reprise::cli
