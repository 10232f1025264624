#pragma once

#include <string_view>
#include <vector>

namespace reprise::world {

/// The words of a list separated by blanks.
std::vector<std::string_view> words(std::string_view text);

}  // namespace reprise::world
