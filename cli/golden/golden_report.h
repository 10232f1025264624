#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/golden/golden_case.h"
#include "cli/golden/golden_runs.h"
#include "replay/compare/divergence.h"
#include "replay/golden/golden_difference.h"

namespace reprise::cli {

enum class CaseResult : std::uint8_t {
    passed,
    changed,
    nondeterministic,
    failed,  ///< without a golden: a check, or the driver was lost
    no_golden,
    not_run,  ///< another program drives, and none was named
    orphan,
    error
};

const char* to_word(CaseResult result);

/// What became of a case.
struct CaseReport {
    GoldenCase tested;
    CaseResult result = CaseResult::passed;
    std::string error_kind;  ///< of an error: script, golden, crash, fault, infrastructure
    std::string headline;    ///< one line
    std::string text;        ///< more lines, each ending in a newline; less than a screen
    std::string signature;   ///< of a change: cases that share it probably share the cause
    double seconds = 0;      ///< of wall time, the candidate's first run
    replay::GivenSetup given;
    DriverOptions drivers;  ///< empty where nobody else drives
    /// Who other programs drove; nothing where nobody else may, or the run did not go to its end.
    std::optional<std::vector<std::string>> driven{};
    std::vector<std::pair<std::string, std::string>> starts;  ///< seed, parameters, ... of the run
};

/// The line and, below it, the rest.
std::string to_text(const CaseReport& report);

/// What is different, in rows; without the commands that come next.
std::string difference_text(const replay::Golden& expected,
                            const replay::Golden& found,
                            const replay::GoldenDifference& difference);

/// The checks that failed, in rows, and why the run ended.
std::string failed_checks_text(const replay::Golden& run);

/// Severity, and the stages of the first checkpoint that differs.
std::string signature_of(const replay::GoldenDifference& difference);

/// Why a run gives no candidate; nothing when it does. `kind` as in CaseReport::error_kind.
struct RunFailure {
    std::string kind;
    std::string headline;
    std::string text;
};

std::optional<RunFailure> failure_of(const process::ProgramResult& result,
                                     const std::filesystem::path& log);

/// "  key         value", continued lines below the value.
std::string report_row(const std::string& key, const std::string& value);

}  // namespace reprise::cli
