#pragma once

#include "cli/options/drive_options.h"

namespace reprise::cli {

/// A person drives, in a scenario that is made of the options; recorded as every run. Throws
/// world::Error. Returns the exit code.
int drive(const DriveOptions& options);

}  // namespace reprise::cli
