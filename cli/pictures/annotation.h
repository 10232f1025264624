#pragma once

#include <cstdint>
#include <optional>

#include "cli/options/render_options.h"
#include "cli/pictures/story.h"

namespace reprise::cli {

/// Writes onto what people look at, where that is wished: the overlay, and the scale of a view from
/// above.
class Annotation {
  public:
    Annotation(const RenderOptions& options, replay::TraceReader& trace);

    /// Before the view of a tick is taken from the trace.
    void read_to(std::uint64_t tick);

    /// Whether it looks at depths: then each camera is to come with its depth picture.
    bool needs_depth() const { return story_.has_value(); }

    /// What a picture is of.
    struct Subject {
        const world::TickView& tick;
        const world::SensorSpec& camera;  ///< in its place
        std::uint32_t actor;              ///< that carries it, or is followed
        bool last;                        ///< nothing is shown after it, and the run ends so
    };

    /// What is said at the tick that was read to.
    struct Words {
        render::ActorNames names;
        render::OverlayText text;
    };

    Words words(const Subject& subject) const;

    /// May be called by several threads, also while others read on.
    void write(world::SensorFrame& shown,
               const world::SensorFrame* depth,
               const Subject& subject,
               const Words& words) const;

  private:
    bool from_above_;
    std::optional<Story> story_;
};

}  // namespace reprise::cli
