#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "world/town_generated.h"

namespace reprise::traffic {

/// Tags of an OpenStreetMap area.
using Tags = std::map<std::string, std::string>;

/// "11.5", "11.5 m", "38'", "38 ft": [m]; nothing when it is not a length above 0.
std::optional<double> length_of(const std::string& text);

/// A building that fills its outline from the ground up; not a roof on posts, nor a cellar.
bool is_building(const Tags& tags);

/// [m] of the eaves: as tagged, else by floors, else usual for the kind.
double eaves_height(const Tags& tags);

/// 1 + index of a model that suits the kind and the floors; `draw` decides between several.
std::uint32_t model_of(const Tags& tags, std::uint64_t draw);

/// What the land is, if it is something that a town shows.
std::optional<world::PlotKind> plot_kind(const Tags& tags);

}  // namespace reprise::traffic
