#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "world/common_generated.h"

namespace reprise::towns {

/// A decimal number, in no locale; `fallback` when the text is not one.
double number(std::string_view text, double fallback);

/// "x,y x,y,z ...": z is 0 where it is left out (netconvert writes it only when it is not 0, point
/// by point). Points nearer than 1 mm to the one before are dropped.
std::vector<world::Vec3> parse_shape(std::string_view text);

/// The junction around an internal edge: ":b1_c0" lies in junction "b1".
std::string junction_around(const std::string& edge);

/// Line of a byte, counted from 1.
std::size_t line_of(std::string_view text, std::size_t offset);

}  // namespace reprise::towns
