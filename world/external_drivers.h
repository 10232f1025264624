#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "world/recording.h"
#include "world/tick.h"

namespace reprise::world {

/// Which vehicles are driven by other programs, tick by tick.
class ExternalDrivers {
  public:
    /// The next tick of a run, as it was recorded whole.
    void hear(const Tick& tick);

    /// By actor: its name.
    const std::map<std::uint32_t, std::string>& names() const { return names_; }

    /// Whether an outcome says that the driver of one of them was lost. Which one cannot be seen in
    /// ticks.
    bool explain(const Outcome& outcome) const;

  private:
    std::map<std::uint32_t, std::string> names_;
};

}  // namespace reprise::world
