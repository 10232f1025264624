#include "towns/maps/map_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "towns/network/network_xml.h"
#include "world/models/building_models.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using world::BuildingUse;
using world::PlotKind;

/// What a building's tag says of its use, and how many floors are usual.
struct Usual {
    const char* tag;
    BuildingUse use;
    double floors;
};

constexpr std::array<Usual, 36> usual_buildings{{
    {"apartments", BuildingUse::flats, 4},    {"residential", BuildingUse::flats, 3},
    {"dormitory", BuildingUse::flats, 4},     {"hotel", BuildingUse::flats, 5},
    {"house", BuildingUse::house, 2},         {"detached", BuildingUse::house, 2},
    {"bungalow", BuildingUse::house, 1},      {"farm", BuildingUse::house, 2},
    {"cabin", BuildingUse::house, 1},         {"semidetached_house", BuildingUse::house, 2},
    {"terrace", BuildingUse::terrace, 2},     {"retail", BuildingUse::shop, 1},
    {"shop", BuildingUse::shop, 1},           {"supermarket", BuildingUse::shop, 1},
    {"kiosk", BuildingUse::shop, 1},          {"commercial", BuildingUse::office, 3},
    {"office", BuildingUse::office, 4},       {"government", BuildingUse::office, 3},
    {"hospital", BuildingUse::office, 4},     {"university", BuildingUse::office, 4},
    {"church", BuildingUse::civic, 3},        {"cathedral", BuildingUse::civic, 5},
    {"chapel", BuildingUse::civic, 2},        {"mosque", BuildingUse::civic, 3},
    {"temple", BuildingUse::civic, 3},        {"school", BuildingUse::civic, 2},
    {"civic", BuildingUse::civic, 2},         {"public", BuildingUse::civic, 2},
    {"train_station", BuildingUse::civic, 2}, {"garage", BuildingUse::garage, 1},
    {"garages", BuildingUse::garage, 1},      {"shed", BuildingUse::garage, 1},
    {"industrial", BuildingUse::garage, 2},   {"warehouse", BuildingUse::garage, 2},
    {"fire_station", BuildingUse::garage, 2}, {"barn", BuildingUse::garage, 2},
}};

constexpr double floor_height = 3;

constexpr double lowest = 2.2, highest = 500;  // [m]

/// [m] of the whole.
std::optional<double> tagged_height(const Tags& tags) {
    const std::optional<double> height = length_of(tag_value(tags, "height"));
    return height ? height : length_of(tag_value(tags, "building:height"));
}

/// [1] as tagged, or as usual for the kind.
double floors_of(const Tags& tags) {
    const double tagged = number(tag_value(tags, "building:levels"), 0);
    if (tagged > 0 && tagged < 200)
        return tagged;
    for (const Usual& usual : usual_buildings)
        if (tag_value(tags, "building") == usual.tag)
            return usual.floors;
    return 2;
}

BuildingUse use_of(const Tags& tags, double floors) {
    if (floors >= 9)
        return BuildingUse::tower;
    for (const Usual& usual : usual_buildings)
        if (tag_value(tags, "building") == usual.tag)
            return usual.use;
    return tag_value(tags, "shop").empty() ? floors <= 2   ? BuildingUse::house
                                             : floors <= 3 ? BuildingUse::terrace
                                                           : BuildingUse::flats
                                           : BuildingUse::shop;
}

/// A tag, and the plot that an area with it becomes.
struct LandUse {
    const char* key;
    const char* value;
    PlotKind kind;
};

// clang-format off
constexpr std::array<LandUse, 30> land_uses{{
    {"natural", "water", PlotKind::water},         {"waterway", "riverbank", PlotKind::water},
    {"landuse", "reservoir", PlotKind::water},     {"landuse", "basin", PlotKind::water},
    {"leisure", "swimming_pool", PlotKind::water}, {"amenity", "parking", PlotKind::car_park},
    {"leisure", "playground", PlotKind::playground},
    {"leisure", "park", PlotKind::park},           {"leisure", "garden", PlotKind::park},
    {"leisure", "nature_reserve", PlotKind::park}, {"leisure", "pitch", PlotKind::lawn},
    {"leisure", "golf_course", PlotKind::lawn},    {"leisure", "common", PlotKind::lawn},
    {"landuse", "grass", PlotKind::lawn},          {"landuse", "meadow", PlotKind::lawn},
    {"landuse", "village_green", PlotKind::lawn},  {"landuse", "recreation_ground", PlotKind::lawn},
    {"landuse", "cemetery", PlotKind::park},       {"landuse", "allotments", PlotKind::lawn},
    {"landuse", "flowerbed", PlotKind::lawn},      {"natural", "grassland", PlotKind::lawn},
    {"natural", "scrub", PlotKind::lawn},          {"natural", "heath", PlotKind::lawn},
    {"landuse", "forest", PlotKind::forest},       {"natural", "wood", PlotKind::forest},
    {"natural", "sand", PlotKind::gravel},         {"natural", "beach", PlotKind::gravel},
    {"landuse", "railway", PlotKind::gravel},      {"place", "square", PlotKind::square},
    {"highway", "pedestrian", PlotKind::square},
}};
// clang-format on

}  // namespace

std::string tag_value(const Tags& tags, const char* key) {
    const auto found = tags.find(key);
    return found == tags.end() ? "" : found->second;
}

std::optional<double> length_of(const std::string& text) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
    const double length = number(std::string_view(text).substr(0, end), 0);
    const std::vector<std::string_view> rest = world::words(std::string_view(text).substr(end));
    const std::string_view unit = rest.empty() ? "" : rest.front();
    const double factor = unit == "'" || unit == "ft" || unit == "feet" ? 0.3048 : 1;
    if (length <= 0 || (factor == 1 && !unit.empty() && unit != "m"))
        return std::nullopt;
    return length * factor;
}

bool is_building(const Tags& tags) {
    const std::string kind = tag_value(tags, "building");
    return !kind.empty() && kind != "no" && kind != "roof" && kind != "carport" &&
           kind != "canopy" && tag_value(tags, "location") != "underground" &&
           number(tag_value(tags, "layer"), 0) >= 0;
}

std::optional<double> ridge_height(const Tags& tags) {
    const std::optional<double> height = tagged_height(tags);
    if (!height || length_of(tag_value(tags, "roof:height")))
        return std::nullopt;
    return std::clamp(*height, lowest, highest);
}

double eaves_height(const Tags& tags) {
    std::optional<double> height = tagged_height(tags);
    // What is tagged is the ridge.
    if (height)
        height = *height - length_of(tag_value(tags, "roof:height")).value_or(0);
    return std::clamp(height.value_or(floors_of(tags) * floor_height), lowest, highest);
}

std::vector<std::vector<std::uint32_t>> suitable_models(const Tags& tags) {
    const double floors = floors_of(tags);
    const auto models = world::building_models();
    const auto named = world::find_building_model(tag_value(tags, "building"));
    const BuildingUse use = named ? models[*named].use : use_of(tags, floors);
    std::vector<std::uint32_t> same_name, same_roof, same_floors, same_use;
    for (std::uint32_t i = 0; i < models.size(); ++i) {
        if (models[i].use != use)
            continue;
        if (i == named)
            same_name.push_back(i);
        else if (named && models[i].roof == models[*named].roof)
            same_roof.push_back(i);
        if (floors >= models[i].fewest_floors && floors <= models[i].most_floors)
            same_floors.push_back(i);
        same_use.push_back(i);
    }
    std::vector<std::vector<std::uint32_t>> suitable;
    // A church is no town hall: of the named civic ones only those with the same roof will do.
    const std::vector<std::vector<std::uint32_t>> all =
        named && use == BuildingUse::civic
            ? std::vector{same_name, same_roof}
            : std::vector{same_name, same_roof, same_floors, same_use};
    for (const auto& each : all)
        if (!each.empty())
            suitable.push_back(each);
    return suitable;
}

std::uint32_t model_of(const Tags& tags, std::uint64_t draw) {
    const std::vector<std::uint32_t> choice = suitable_models(tags).front();
    return 1 + choice[draw % choice.size()];
}

std::optional<PlotKind> plot_kind(const Tags& tags) {
    for (const LandUse& land : land_uses)
        if (tag_value(tags, land.key) == land.value)
            return land.kind;
    return std::nullopt;
}

}  // namespace reprise::towns
