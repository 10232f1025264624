#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "kernel/kernel.h"
#include "replay/trace_reader.h"
#include "tests/replay/synthetic_run.h"
#include "world/recording.h"

/// Whole runs, from a scenario's text.
namespace reprise::test {

/// Town 1 with this scenario; `body` is what its run function does.
world::Recording in_town1(const std::string& body, unsigned cars, double seconds);

/// Likewise on tests/maps/lanes.net.xml, without background cars.
world::Recording on_straight_lanes(const std::string& body, double seconds);

/// Likewise in one of scenarios/towns, without background cars.
world::Recording in_town(const std::string& town, const std::string& body, double seconds);

/// A tick's bytes, kept.
class KeptTick {
  public:
    explicit KeptTick(const world::SealedTick& tick);

    replay::RecordedTick recorded() const;

  private:
    std::vector<std::uint8_t> tick_;
    std::vector<std::uint8_t> traffic_;
};

/// Runs it to its end. `prepare` may ask the kernel for a drill.
std::vector<KeptTick> run(const world::Recording& recording,
                          const std::function<void(kernel::Kernel&)>& prepare = {});

}  // namespace reprise::test
