#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "process/program.h"

namespace reprise::cli {

/// One call of the program that simulates.
struct GoldenRun {
    std::vector<std::string> words;  ///< behind "reprise": run SCENARIO ...
    std::filesystem::path log;       ///< gets what it prints
};

/// Runs `reprise run` in processes of their own, some at a time: libsumo's state belongs to the
/// process. While it lives, signals that would end us are kept for `run`, so that nothing is left
/// behind; children end with us, whatever ends us.
class GoldenRunner {
  public:
    /// As many jobs as there are processors when 0.
    explicit GoldenRunner(std::size_t jobs);

    /// Results in the order of `runs`. `done` hears how many are through, ten times a second.
    /// Throws process::Stopped when the user ends it.
    std::vector<process::ProgramResult> run(
        const std::vector<GoldenRun>& runs,
        const std::function<void(std::size_t done)>& done = {}) const;

  private:
    process::Children children_;
    std::filesystem::path program_;
};

}  // namespace reprise::cli
