#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/render_options.h"
#include "cli/pictures/cameras.h"
#include "cli/trace/usual_carrier.h"
#include "replay/trace_reader.h"
#include "world/external/rig.h"

namespace reprise::cli {

/// The sensors of a vehicle that are no cameras, when each of them looks, and who carries it.
class MeasuredRig {
  public:
    /// Of the recorded rig, of a rig file, or as options name them. Throws world::Error.
    MeasuredRig(const RenderOptions& options, replay::TraceReader& trace, const Ticks& ticks);

    const world::SensorRig& sensors() const { return rig_.sensors; }

    /// One more sensor, last, in the place and at the ticks of another: which actors that LiDAR's
    /// beams meet.
    void add_semantic_twin(std::size_t lidar);

    /// All of them look every so many ticks, and go on holding in a frame what they held.
    void look_every(std::uint32_t ticks) { rig_.every.assign(rig_.sensors.size(), ticks); }

    /// For people.
    std::string names() const;

    /// Whose frame its place is in, for people: "ego", "world".
    std::string mounted_on(std::size_t sensor) const;

    bool is_due(std::size_t sensor, std::uint64_t tick) const { return rig_.is_due(sensor, tick); }

    /// Who carries them in this tick, of those that are there: by the sensor's index. 0: the world.
    std::map<std::size_t, std::uint32_t> carriers(const world::TickView& tick) const;

    /// One in its place: who carries it may be another one in the next tick.
    world::SensorSpec placed(std::size_t sensor, std::uint32_t actor) const;

    /// One table for all ticks; others have a file for each.
    static bool has_table(world::SensorKind kind) {
        return world::is_reading(kind) || kind == world::SensorKind::obstacle;
    }

  private:
    void look_up_rig();
    std::optional<std::uint32_t> carrier(std::size_t sensor, const world::TickView& tick) const;

    const RenderOptions& options_;
    replay::TraceReader& trace_;
    Ticks ticks_;
    world::Rig rig_;
    std::vector<std::string> carriers_;  ///< of a rig file's, by name; else empty
    std::vector<std::optional<std::uint32_t>> carrier_ids_;  ///< of a rig file's; else empty
    std::optional<std::uint32_t> named_;
    UsualCarrier usual_;
};

}  // namespace reprise::cli
