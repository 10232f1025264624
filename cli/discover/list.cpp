#include "cli/discover/list.h"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "cli/discover/list_places.h"
#include "cli/discover/sheet.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/say.h"
#include "scripting/annotations.h"
#include "scripting/run/language.h"
#include "world/check.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/weather/air.h"
#include "world/weather/weather.h"

namespace reprise::cli {

namespace {

using scripting::Owner;

Sheet model_sheet() {
    Sheet sheet({{"model", "name"},
                 {"class", "sumo_class"},
                 {"length [m]", "length"},
                 {"width [m]", "width"},
                 {"height [m]", "height"},
                 {"wheelbase [m]", "wheelbase"},
                 {"rear overhang [m]", "rear_overhang"},
                 {"mass [kg]", "mass", 0},
                 {"power [W]", "power", 0}});
    for (const world::VehicleModel& model : world::vehicle_models())
        sheet.add({model.name,
                   model.sumo_class,
                   model.length,
                   model.width,
                   model.height,
                   model.wheelbase,
                   model.rear_overhang,
                   model.mass,
                   model.power});
    return sheet;
}

const char* age_name(world::Age age) {
    constexpr const char* names[] = {"child", "teen", "adult", "senior"};
    return names[static_cast<std::size_t>(age)];
}

Sheet prop_sheet() {
    Sheet sheet({{"model", "name"},
                 {"length [m]", "length"},
                 {"width [m]", "width"},
                 {"height [m]", "height"},
                 {"mass [kg]", "mass", 1}});
    for (const world::PropModel& model : world::prop_models())
        sheet.add({model.name, model.length, model.width, model.height, model.mass});
    return sheet;
}

Sheet walker_sheet() {
    Sheet sheet({{"model", "name"},
                 {"age", "age"},
                 {"height [m]", "height"},
                 {"shoulders [m]", "shoulder_width"},
                 {"mass [kg]", "mass", 0},
                 {"walks [m/s]", "walking_speed"}});
    for (const world::WalkerModel& model : world::walker_models())
        sheet.add({model.name,
                   age_name(model.age),
                   model.height,
                   model.shoulder_width,
                   model.mass,
                   model.walking_speed});
    return sheet;
}

/// Without the digits that a float has too many as a double.
double real(double single) {
    return std::round(single * 1e6) / 1e6;
}

double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

Sheet weather_sheet() {
    Sheet sheet({{"weather", "name"},
                 {"of", "source"},
                 {"grip", "road_friction"},
                 {"sun [deg]", "sun_altitude_deg", 0},
                 {"clouds", "cloud_cover"},
                 {"rain [mm/h]", "rain_mm_per_h", 1},
                 {"fog [m]", "visibility", 0},
                 {"fog [1/m]", "fog_extinction", 4},
                 {"wet", "wetness"},
                 {"puddles", "puddles"},
                 {"wind [m/s]", "wind_speed", 1},
                 {"snow [mm/h]", "snow_mm_per_h", 1},
                 {"snow on ground", "snow_cover"},
                 {"dust [1/m]", "dust", 4}});
    for (const world::WeatherPreset& preset : world::weather_presets()) {
        const world::Weather& weather = preset.weather;
        const double visibility =
            world::range_by_extinction / static_cast<double>(weather.fog_extinction());
        sheet.add({preset.name,
                   std::string(preset.source),
                   preset.road_friction,
                   real(degrees(weather.sun_altitude())),
                   real(weather.cloud_cover()),
                   real(weather.rain()),
                   std::round(visibility),
                   real(weather.fog_extinction()),
                   real(weather.wetness()),
                   real(weather.puddles()),
                   real(weather.wind_speed()),
                   real(weather.snow()),
                   real(weather.snow_cover()),
                   real(weather.dust())});
    }
    return sheet;
}

std::string said(const scripting::WordList& list, const scripting::Word& word) {
    const char* owner = list.owner == Owner::actor   ? "ego:"
                        : list.owner == Owner::check ? "check."
                        : list.owner == Owner::task  ? "task:"
                                                     : "";
    return std::string(owner) + word.name;
}

Sheet word_sheet(bool only_checks) {
    Sheet sheet(
        {{"word", "word"}, {"takes, returns", "signature"}, {"", "meaning"}, {"group", "group"}});
    for (const scripting::WordList& list : scripting::vocabulary())
        for (const scripting::Word& word : list.words)
            if (!only_checks || list.owner == Owner::check)
                sheet.add({said(list, word), word.signature, word.meaning, list.group});
    return sheet;
}

/// One word whole: what it takes, with the keys of its tables. False when there is none.
bool tell_word(const std::string& wanted) {
    bool found = false;
    for (const scripting::WordList& list : scripting::vocabulary())
        for (const scripting::Word& word : list.words) {
            if (word.name != wanted && said(list, word) != wanted)
                continue;
            say("{}{}{}\n  {}\n",
                found ? "\n" : "",
                said(list, word),
                word.signature,
                word.meaning);
            found = true;
            const std::string signature = word.signature;
            for (const scripting::KeyList& keys : scripting::vocabulary_keys()) {
                if (signature.find(keys.type) == std::string::npos)
                    continue;
                Sheet sheet({{keys.type, "key"}, {"", "type"}, {"", "meaning"}});
                for (const scripting::Key& key : keys.keys)
                    sheet.add({fmt::format("  {}{}", key.name, key.required ? "" : "?"),
                               key.type,
                               key.meaning});
                say_lines("\n" + sheet.text());
            }
        }
    return found;
}

Sheet sheet_of(const ListOptions& options) {
    if (options.noun == "models")
        return model_sheet();
    if (options.noun == "walkers")
        return walker_sheet();
    if (options.noun == "props")
        return prop_sheet();
    if (options.noun == "weathers")
        return weather_sheet();
    if (options.noun == "towns")
        return town_sheet();
    if (options.noun == "scenarios")
        return scenario_sheet();
    if (options.noun != "lanes")
        return word_sheet(options.noun == "checks");
    if (options.words.empty())
        throw world::Error(
            "list lanes: of which town? reprise list lanes town1; reprise list towns "
            "names them");
    return lane_sheet(options.words.front(), options.all);
}

}  // namespace

int list(const ListOptions& options) {
    end_quietly_when_nobody_reads();
    const std::size_t most = options.noun == "lanes" ? 2 : 1;
    if (options.words.size() > most)
        throw world::Error("list " + options.noun + ": one text to look for, got '" +
                           options.words[0] + "' and '" + options.words[1] + "'");
    if ((options.luals || options.markdown) && options.noun != "words")
        throw world::Error("list " + options.noun + ": --luals and --markdown are of `list words`");
    if (options.all && options.noun != "lanes")
        throw world::Error("list " + options.noun + ": --all is of `list lanes`");
    if (options.luals || options.markdown) {
        say_lines(options.luals ? scripting::annotations() : scripting::words_page());
        return exit_good;
    }
    const std::string wanted = options.words.size() == most ? options.words.back() : "";
    if (options.noun == "words" && !wanted.empty() && !options.json && tell_word(wanted))
        return exit_good;
    Sheet sheet = sheet_of(options);
    const std::size_t there = sheet.size();
    if (!wanted.empty())
        sheet.keep(wanted);
    if (sheet.size() == 0 && there != 0 && !options.json)
        throw world::Error(
            fmt::format("list {}: none of {} rows holds '{}'", options.noun, there, wanted));
    say_lines(options.json ? sheet.json() : sheet.text());
    return exit_good;
}

}  // namespace reprise::cli
