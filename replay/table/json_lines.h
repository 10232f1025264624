#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "replay/table/selection.h"
#include "replay/trace_reader.h"
#include "world/episode_generated.h"
#include "world/town_generated.h"

namespace reprise::replay {

/// Ticks as JSON, a line for each of the two streams of a tick, digits as in append_json:
/// {"topic":"/sim/tick","tick":"1","time":0.05,"vehicles":[{"id":1,...},...],...}
class JsonLines {
  public:
    /// Throws world::Error for a field that there is not. A stream of which nothing is wanted gets
    /// no line.
    JsonLines(const Selection& selection, std::uint64_t step_ns);
    ~JsonLines();
    JsonLines(const JsonLines&) = delete;
    JsonLines& operator=(const JsonLines&) = delete;

    void append_tick(const RecordedTick& tick, std::string& out) const;
    void append_traffic(const RecordedTick& tick, std::string& out) const;

  private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// The nouns that a trace holds once.
std::string to_json(const world::Episode& episode);
std::string to_json(const world::Town& town);

}  // namespace reprise::replay
