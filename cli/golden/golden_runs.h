#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace reprise::cli {

/// One call of the program that simulates.
struct GoldenRun {
    std::vector<std::string> words;  ///< behind "reprise": run SCENARIO ...
    std::filesystem::path log;       ///< gets what it prints
};

struct GoldenRunResult {
    int code = 0;    ///< exit status
    int signal = 0;  ///< that ended it; 0: none did
    double seconds = 0;
};

/// SIGINT, SIGTERM or SIGHUP came; all children are ended.
class Interrupted : public std::runtime_error {
  public:
    explicit Interrupted(int number) : std::runtime_error("interrupted"), signal(number) {}

    int signal;
};

/// Runs `reprise run` in processes of their own, some at a time: libsumo's state belongs to the
/// process. While it lives, signals that would end us are kept for `run`, so that nothing is left
/// behind; children end with us, whatever ends us.
class GoldenRunner {
  public:
    explicit GoldenRunner(std::size_t jobs);
    ~GoldenRunner();
    GoldenRunner(const GoldenRunner&) = delete;
    GoldenRunner& operator=(const GoldenRunner&) = delete;

    /// Results in the order of `runs`. `done` hears how many are through, ten times a second.
    std::vector<GoldenRunResult> run(const std::vector<GoldenRun>& runs,
                                     const std::function<void(std::size_t done)>& done = {});

  private:
    struct Signals;
    std::unique_ptr<Signals> signals_;
    std::filesystem::path program_;
    std::size_t jobs_;
};

/// As many as there are processors for this process.
std::size_t default_jobs();

}  // namespace reprise::cli
