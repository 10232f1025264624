#pragma once

#include <filesystem>
#include <string>

namespace reprise::cli {

/// The network file of a town: a path is taken as it is; a name is looked up as
/// towns/NAME/NAME.net.xml beside the scenario, then in the scenarios that belong to this program.
/// Throws world::Error that lists the towns there are.
std::filesystem::path find_network(const std::string& town, const std::filesystem::path& scenario);

}  // namespace reprise::cli
