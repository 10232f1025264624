#include "cli/golden/golden_runs.h"

#include "cli/process/helper_program.h"

namespace reprise::cli {

GoldenRunner::GoldenRunner(std::size_t jobs)
    : children_(jobs == 0 ? process::processors() : jobs),
      program_(helper_program("reprise-run")) {}

std::vector<process::ProgramResult> GoldenRunner::run(
    const std::vector<GoldenRun>& runs, const std::function<void(std::size_t)>& done) const {
    std::vector<process::Program> programs;
    for (const GoldenRun& run : runs)
        // What a run that is killed leaves behind goes with the folder of ours that holds its log.
        programs.push_back({.name = program_,
                            .words = run.words,
                            .log = run.log,
                            .variables = {"TMPDIR=" + run.log.parent_path().string()}});
    return process::run_programs(children_, programs, done);
}

}  // namespace reprise::cli
