#include "cli/options/option_checks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "world/check.h"
#include "world/external/rig.h"
#include "world/lanes/density.h"
#include "world/weather/weather_course.h"
#include "world/weather/weather_text.h"

namespace reprise::cli {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ", ") + word;
    return text;
}

CLI::Validator one_of(std::vector<std::string> words, const std::string& what) {
    return CLI::Validator(
        [words, what](std::string& word) -> std::string {
            if (std::find(words.begin(), words.end(), word) != words.end())
                return "";
            return "no " + what + " '" + word + "'" + world::did_you_mean(word, words) +
                   "; there are " + joined(words);
        },
        "");
}

CLI::Validator a_weather() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            try {
                world::read_weather(text);
                return "";
            } catch (const world::Error& error) {
                return error.what();
            }
        },
        "");
}

CLI::Validator a_weather_course() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            try {
                if (!world::changes_of_recorded(text))
                    world::WeatherCourse{text};
                return "";
            } catch (const world::Error& error) {
                return error.what();
            }
        },
        "");
}

void add_ticks(CLI::App& command, std::string& ticks) {
    command
        .add_option("--ticks", ticks, "Only these, such as 100..200, 2.5s.. or ..10s (default all)")
        ->type_name("A..B");
}

void add_actor(CLI::App& command, std::string& actor) {
    command.add_option("--actor", actor, "Only what belongs to this actor: its name or its id")
        ->type_name("NAME");
}

PictureSize read_picture_size(const std::string& text, const std::string& such_as) {
    PictureSize size;
    int used = 0;
    // Nine digits: more do not fit, and are too many.
    const int found = std::sscanf(text.c_str(), "%9dx%9d%n", &size.width, &size.height, &used);
    if (found != 2 || used != static_cast<int>(text.size()) || size.width < 1 || size.height < 1)
        throw world::Error(
            fmt::format("expected WIDTHxHEIGHT such as {}, got '{}'", such_as, text));
    if (std::max(size.width, size.height) > world::largest_picture_side)
        throw world::Error(fmt::format(
            "{} is too large: at most {} pixels a side", text, world::largest_picture_side));
    return size;
}

CLI::Validator a_number_in(double low, double high) {
    return CLI::Validator(
        [low, high](std::string& text) -> std::string {
            double value = std::nan("");
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error != std::errc() || stop != end || !(value >= low && value <= high))
                return fmt::format(
                    "expected a number from {:g} to {:g}, got '{}'", low, high, text);
            return "";
        },
        "");
}

CLI::Validator whole_number() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error != std::errc() || stop != end)
                return "expected a whole number from 0 to 18446744073709551615, got '" + text + "'";
            text = std::to_string(value);  // without the leading zeros of an octal number
            return "";
        },
        "");
}

CLI::Validator number_of_cars() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            constexpr std::uint32_t most = 10'000;
            std::uint32_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (text == "auto")
                value = world::auto_cars;
            else if (error != std::errc() || stop != end || value > most)
                return "expected a whole number from 0 to 10000, or auto, got '" + text + "'";
            text = std::to_string(value);
            return "";
        },
        "");
}

CLI::Validator number_of_walkers() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            constexpr std::uint32_t most = 2'000;
            std::uint32_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error != std::errc() || stop != end || value > most)
                return "expected a whole number from 0 to 2000, got '" + text + "'";
            text = std::to_string(value);
            return "";
        },
        "");
}

std::vector<std::pair<std::string, std::string>> said_words(const CLI::App& command) {
    std::vector<std::pair<std::string, std::string>> said;
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_lnames().empty() ? "" : option->get_lnames().front();
        if (option->count() == 0 || name.empty() || name == "output" || name == "threads" ||
            name == "rig" || name == "check")
            continue;
        std::string value;
        for (const std::string& one : option->results())
            value += (value.empty() ? "" : ",") + one;
        said.emplace_back("--" + name, value);
    }
    return said;
}

void check_alone(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            if (option->count() > 0 && name != "check" && name != "threads")
                throw CLI::ValidationError("--check", "the manifest says it: without --" + name);
}

}  // namespace reprise::cli
