#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace reprise::cli {

/// A bar on stderr when that is a terminal, nothing otherwise. Clocks are in cli/ only: they
/// never touch what is simulated.
class Progress {
  public:
    /// `what` such as "running"; `unit` such as "ticks".
    Progress(std::string what, std::string unit, std::uint64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Cheap: draws at most ten times a second.
    void update(std::uint64_t done);

    /// Takes the bar away.
    void clear();

    double seconds() const;

  private:
    void draw(std::uint64_t done);

    std::string what_;
    std::string unit_;
    std::uint64_t total_;
    bool on_terminal_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point next_;
};

}  // namespace reprise::cli
