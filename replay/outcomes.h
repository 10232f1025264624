#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "replay/trace_reader.h"
#include "world/external/external_drivers.h"
#include "world/recording.h"

namespace reprise::replay {

/// Gathers from a run's ticks how it ended.
class ToldOutcome {
  public:
    void hear(const world::Tick& tick);

    /// What all events of a trace say. Nothing when the run's end is not among them, or its start,
    /// or what a script had seen that another took the place of.
    std::optional<world::Outcome> of(const TraceReader& trace) const;

    /// "its outcome says 'passed: arrived', its ticks 'failed: arrived'", or nothing. `all`: every
    /// tick was heard, else only the first and the last ones.
    std::optional<std::string> contradiction(const TraceReader& trace, bool all) const;

  private:
    std::optional<std::string> finished_;  ///< why
    bool failed_ = false;
    bool passed_ = false;
    world::ExternalDrivers external_;
};

/// Hears every tick.
std::optional<world::Outcome> told_outcome(TraceReader& trace);

/// "passed: arrived", for people: what a terminal would obey is written out.
std::string to_text(const world::Outcome& outcome);

}  // namespace reprise::replay
