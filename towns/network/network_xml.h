#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "world/common_generated.h"

namespace reprise::traffic {

/// A set of SUMO's vehicle classes, one bit each, in the order of vehicle_class_names().
using ClassSet = std::uint32_t;

/// What SUMO 1.15 knows; a newer network may name others.
const std::vector<std::string_view>& vehicle_class_names();

/// The class as a set of one; 0 when SUMO 1.15 does not know it.
ClassSet class_bit(std::string_view name);

/// Who may use a lane, from its `allow` and `disallow` attributes: `allow` wins; both empty: all.
/// Unknown words are ignored.
ClassSet permitted(std::string_view allow, std::string_view disallow);

/// The words of a list separated by blanks.
std::vector<std::string_view> words(std::string_view text);

/// A decimal number, in no locale; `fallback` when the text is not one.
double number(std::string_view text, double fallback);

/// "x,y x,y,z ...": z is 0 where it is left out (netconvert writes it only when it is not 0, point
/// by point). Points nearer than 1 mm to the one before are dropped.
std::vector<world::Vec3> parse_shape(std::string_view text);

/// The junction around an internal edge: ":b1_c0" lies in junction "b1".
std::string junction_around(const std::string& edge);

/// Line of a byte, counted from 1.
std::size_t line_of(std::string_view text, std::size_t offset);

}  // namespace reprise::traffic
