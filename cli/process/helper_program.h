#pragma once

#include <filesystem>
#include <string>

namespace reprise::cli {

/// The program of that name: beside this one, or in ../libexec/reprise where an installation puts
/// it. Throws world::Error when it is in neither place.
std::filesystem::path helper_program(const std::string& name);

}  // namespace reprise::cli
