#pragma once

#include <string>
#include <string_view>

/// Private to the room: what those who write and read goldens share.
namespace reprise::replay {

inline constexpr std::string_view golden_first_line = "reprise golden 1";  ///< and its format

/// Of all that stands before the line of the seal.
std::string golden_seal(std::string_view text);

}  // namespace reprise::replay
