#pragma once

#include <string>

#include "cli/options/drive_options.h"

namespace reprise::cli {

/// --driver NAME=keyboard: a person is to drive.
inline constexpr const char* keyboard_word = "keyboard";

/// The line for the shell that lets a person drive. Throws world::Error, one line, where there is
/// nothing to look at: before anything is recorded.
std::string wheel_command(const WheelOptions& options = {});

}  // namespace reprise::cli
