#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/options/run_options.h"
#include "replay/golden/golden.h"

namespace reprise::cli {

/// A scenario together with the golden that lies beside it: cut_in.golden for the scenario as it
/// stands, cut_in@late.golden for a case that gives it another seed, town, length or parameters.
struct GoldenCase {
    std::filesystem::path scenario;  ///< of an orphan: where it should be
    std::filesystem::path golden;    ///< where it is, or would be
    std::string name;                ///< "late"; "" for the scenario as it stands
    enum class State : std::uint8_t {
        ready,
        no_golden,
        external,  ///< no golden, and it says that another program drives: its checks only are
                   ///< tested
        orphan
    } state = State::ready;

    /// "scenarios/cut_in@late": what reports call it, and `reprise test` takes.
    std::string label() const;
};

struct FoundCases {
    std::vector<GoldenCase> cases;   ///< sorted by golden
    std::vector<std::string> notes;  ///< what was passed over, and why
};

/// All cases of these scenarios, goldens and folders (with what is below them); of none: of
/// `scenarios`, or of this folder where there is no such one. Throws world::Error for a path that
/// is none of these.
FoundCases find_cases(const std::vector<std::string>& paths);

/// The one case that is meant: a scenario, with or without a case's name, or a golden, also one
/// that is not there yet.
GoldenCase named_case(const std::string& path, const std::string& name);

/// What a golden keeps of a town that is given by its file: its place, seen from the golden.
std::string stored_town(const std::string& town, const std::filesystem::path& golden);

/// The words behind "reprise": run SCENARIO --seed ... -o TRACE. No "-o" without a trace.
std::vector<std::string> run_words(const GoldenCase& tested,
                                   const replay::GivenSetup& given,
                                   const std::filesystem::path& trace = {},
                                   const DriverOptions& drivers = {});

/// A command as one would type it.
std::string command_line(const std::vector<std::string>& words);

/// The command that accepts the case as it now is; of a new case, with what makes it different.
std::string accept_command(const GoldenCase& tested);

}  // namespace reprise::cli
