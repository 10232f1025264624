#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "render/overlay/overlay.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

/// What a run's events tell while it is watched: names, and lines that stay for a moment.
class Story {
  public:
    /// `trace` must outlive it.
    explicit Story(replay::TraceReader& trace);

    /// Reads on up to this tick. Views of the trace's ticks end.
    void read_to(std::uint64_t tick);

    const render::ActorNames& names() const { return names_; }

    /// What is written onto a picture of a tick that was read; `last`: the run ends with it.
    render::OverlayText text(const world::TickView& tick, std::uint32_t actor, bool last) const;

  private:
    struct Line {
        std::uint64_t tick;
        render::OverlayLine line;
        std::uint32_t one = 0;  ///< of a collision: who with whom
        std::uint32_t other = 0;
        double impulse = 0;  ///< [N s] the largest yet
    };

    void hear(const world::Event& event, std::uint64_t tick);
    void hear_collision(const world::Event& event, std::uint64_t tick);
    std::string name_of(std::uint32_t actor) const;

    replay::TraceReader& trace_;
    std::uint64_t read_;    ///< the last tick that was read
    std::uint64_t moment_;  ///< [ticks]
    render::ActorNames names_;
    render::ActorNames models_;  ///< of the demand's actors, which have no names
    std::deque<Line> lines_;
};

}  // namespace reprise::cli
