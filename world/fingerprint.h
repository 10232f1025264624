#pragma once

#include <string>
#include <utility>
#include <vector>

namespace reprise::world {

/// What this build was made of, line by line: {"reprise", "0.1.0"}, {"compiler", "..."}, ...
/// Two builds with equal fingerprints give equal bytes; a trace keeps the one that recorded it.
std::vector<std::pair<std::string, std::string>> build_fingerprint();

}  // namespace reprise::world
