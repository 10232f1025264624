#pragma once

#include <vector>

#include "cli/golden/golden_case.h"
#include "cli/golden/golden_report.h"
#include "cli/options/options.h"

namespace reprise::cli {

struct SuiteResult {
    std::vector<CaseReport> reports;  ///< one for each case, in their order
    double seconds = 0;               ///< of wall time
};

/// Runs all cases that have a golden and says what became of every one. A mistake in a case is that
/// case's; throws process::Stopped when the user ends it.
SuiteResult run_suite(const TestOptions& options, std::vector<GoldenCase> cases);

}  // namespace reprise::cli
