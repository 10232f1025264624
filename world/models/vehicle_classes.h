#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace reprise::world {

/// A set of SUMO's vehicle classes, one bit each, in the order of vehicle_class_names().
using ClassSet = std::uint32_t;

/// What SUMO 1.15 knows; a newer network may name others.
const std::vector<std::string_view>& vehicle_class_names();

/// The class as a set of one; 0 when SUMO 1.15 does not know it.
ClassSet class_bit(std::string_view name);

/// Who may use a lane, from its `allow` and `disallow` attributes: `allow` wins; both empty: all.
/// Unknown words are ignored.
ClassSet permitted(std::string_view allow, std::string_view disallow);

}  // namespace reprise::world
