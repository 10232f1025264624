#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace reprise::replay {

/// Shortest decimal that reads back the same: "0.1", "1e-07", "nan".
std::string decimal(double value);
std::string decimal(float value);

/// That decimal, and the bits: "0.1 (0x3fb999999999999a)".
std::string value_text(double value);
std::string value_text(float value);

/// "3 units in the last place apart", or "" when that would be no help: far apart, or not numbers.
std::string distance_text(double expected, double found);
std::string distance_text(float expected, float found);

/// Both texts around their first difference: of long ones only the line that differs.
std::pair<std::string, std::string> text_pair(std::string_view expected, std::string_view found);

}  // namespace reprise::replay
