#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "world/town_generated.h"

namespace reprise::towns {

/// Tags of an OpenStreetMap object, by their keys.
using Tags = std::map<std::string, std::string>;

/// "" when there is no such tag.
std::string tag_value(const Tags& tags, const char* key);

/// "11.5", "11.5 m", "38'", "38 ft": [m]; nothing when it is not a length above 0.
std::optional<double> length_of(const std::string& text);

/// A building that fills its outline from the ground up; not a roof on posts, nor a cellar.
bool is_building(const Tags& tags);

/// [m] of the ridge, where the map says how high the whole is, but not how high its roof.
std::optional<double> ridge_height(const Tags& tags);

/// [m] of the eaves: as tagged, else by floors, else usual for the kind.
double eaves_height(const Tags& tags);

/// 1 + index of a model that suits the kind and the floors; `draw` decides between several.
std::uint32_t model_of(const Tags& tags, std::uint64_t draw);

/// Indices of models that suit the kind, the best ones first: called as the map calls it; then as
/// that one in use and roof; then of the use, with as many floors; then of the use.
std::vector<std::vector<std::uint32_t>> suitable_models(const Tags& tags);

/// The plot that an area of land use becomes; nothing for those that a town does not show.
std::optional<world::PlotKind> plot_kind(const Tags& tags);

}  // namespace reprise::towns
