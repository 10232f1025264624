#pragma once

#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace reprise::cli {

/// "a, b, c"
std::string joined(const std::vector<std::string>& words);

/// Accepts only words of the list, and suggests the nearest.
CLI::Validator one_of(std::vector<std::string> words, const std::string& what);

/// A weather as world::read_weather takes it: a preset, numbers, or both.
CLI::Validator a_weather();

/// A weather that may change over time, as world::WeatherCourse takes it, or "recorded", also
/// with changes.
CLI::Validator a_weather_course();

/// Adds --ticks A..B and --actor NAME: one spelling wherever ticks and an actor are chosen.
void add_ticks(CLI::App& command, std::string& ticks);
void add_actor(CLI::App& command, std::string& actor);

/// Width and height [px].
struct PictureSize {
    int width = 0;
    int height = 0;
};

/// Of "800x600". A picture is worked on whole, with about 200 bytes of memory a pixel: so its sides
/// and its area have an end. Throws world::Error; `such_as` is an example for its line.
PictureSize read_picture_size(const std::string& text, const std::string& such_as);

/// A number within; CLI::Range takes what is none, "nan".
CLI::Validator a_number_in(double low, double high);

/// Decimal digits only: what CLI11 reads as a number may also be octal, negative or too large.
CLI::Validator whole_number();

/// A number of background cars; `auto` becomes world::auto_cars.
CLI::Validator number_of_cars();

/// A number of people on foot in the background.
CLI::Validator number_of_walkers();

/// What a manifest keeps of a command's options, as they were said: another place, and other
/// threads, make the same, and a rig is kept whole.
std::vector<std::pair<std::string, std::string>> said_words(const CLI::App& command);

/// Throws CLI::ValidationError where options are said beside --check, which are in the manifest.
void check_alone(const CLI::App& command);

}  // namespace reprise::cli
