#include "world/weather/weather_course.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "world/check.h"
#include "world/weather/weather_mix.h"
#include "world/weather/weather_text.h"

namespace reprise::world {

namespace {

constexpr double latest = 86'400;  // [s] as in scenarios

/// TIME:WHAT
struct Timed {
    std::string time;
    std::string what;
};

std::vector<Timed> parted(const std::string& text) {
    std::vector<Timed> stops;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        const std::size_t colon = part.find(':');
        if (colon != std::string::npos)
            stops.push_back({part.substr(0, colon), part.substr(colon + 1)});
        else if (stops.empty())
            stops.push_back({"0s", part});
        else
            stops.back().what += "," + part;
        begin = end + 1;
    }
    return stops;
}

double seconds_of(const std::string& time) {
    double seconds = 0;
    const char* end = time.data() + time.size();
    const auto [stop, error] = std::from_chars(time.data(), end, seconds);
    if (error != std::errc() || stop + 1 != end || *stop != 's' ||
        !(seconds >= 0 && seconds <= latest))
        throw Error(
            fmt::format("expected a time from 0s to {:g}s such as 30s or 2.5s before ':', got '{}'",
                        latest,
                        time));
    return seconds;
}

}  // namespace

std::optional<std::string> changes_of_recorded(const std::string& text) {
    const std::string word = "recorded";
    if (text == word)
        return "";
    if (text.compare(0, word.size() + 1, word + ",") != 0 || text.find(':') != std::string::npos)
        return std::nullopt;
    std::string changes = text.substr(word.size() + 1);
    const std::string first = changes.substr(0, changes.find(','));
    if (first.find('=') == std::string::npos)
        throw Error(
            fmt::format("expected KEY=VALUE such as rain=8 behind recorded, got '{}'", first));
    read_weather(changes);
    return changes;
}

WeatherCourse::WeatherCourse(const std::string& text) : name_(text) {
    if (text.find(':') == std::string::npos) {
        stops_.push_back({0, read_weather(text)});
        return;
    }
    for (const Timed& timed : parted(text)) {
        const double at = seconds_of(timed.time);
        if (changes_of_recorded(timed.what))
            throw Error(
                fmt::format("{}: what was recorded has times of its own: recorded, or "
                            "recorded,rain=8, stands alone",
                            timed.time));
        if (!stops_.empty() && at <= stops_.back().at)
            throw Error(fmt::format(
                "{}: the stop before is at {:g}s: times must grow", timed.time, stops_.back().at));
        stops_.push_back({at,
                          stops_.empty() ? read_weather(timed.what)
                                         : read_weather(timed.what, stops_.back().said.weather)});
    }
}

Weather WeatherCourse::at(double seconds) const {
    std::size_t next = 0;
    while (next < stops_.size() && stops_[next].at <= seconds)
        ++next;
    if (next == 0)
        return stops_.front().said.weather;
    const WeatherStop& last = stops_[next - 1];
    if (next == stops_.size())
        return last.said.weather;
    return mixed(last.said.weather,
                 stops_[next].said.weather,
                 (seconds - last.at) / (stops_[next].at - last.at));
}

}  // namespace reprise::world
