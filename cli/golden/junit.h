#pragma once

#include <filesystem>
#include <vector>

#include "cli/golden/golden_report.h"

namespace reprise::cli {

/// Writes what CI servers read: one testcase a case, with seed, parameters and the command that
/// runs it again as properties. failure: changed, nondeterministic, failed, no_golden, not_run,
/// orphan; error: the kind of error. Appears under its name when it is whole. Throws world::Error.
void write_junit(const std::filesystem::path& path,
                 const std::vector<CaseReport>& reports,
                 double seconds);

}  // namespace reprise::cli
