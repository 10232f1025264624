#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "world/episode_generated.h"

namespace reprise::scripting {

/// The largest file that may come with a scenario. [bytes]
inline constexpr std::uintmax_t longest_companion = std::uintmax_t{1} << 20U;

/// Is it a name of a file beside the script: without a folder, and not hidden?
bool is_plain_name(std::string_view name);

/// The files beside a script that it names: texts in its source, and parameters, that end in
/// ".csv". They are read whole, because the run must be the same where they are not; sorted by
/// name. One that is not there is left out: the script may never ask for it. Throws world::Error
/// for one that cannot be read or is too large.
std::vector<world::FileT> companions_of(const std::string& source,
                                        const std::vector<world::ParameterT>& parameters,
                                        const std::filesystem::path& folder);

}  // namespace reprise::scripting
