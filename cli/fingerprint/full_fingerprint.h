#pragma once

#include <string>
#include <utility>
#include <vector>

namespace reprise::cli {

/// The build's fingerprint, and the libraries as they are loaded in this process: Debian may have
/// given another SUMO, Bullet or Lua to the same executable since. A library is named by the first
/// 16 digits of its GNU build id.
std::vector<std::pair<std::string, std::string>> full_fingerprint();

}  // namespace reprise::cli
