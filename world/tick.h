#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "world/common_generated.h"
#include "world/tick_generated.h"
#include "world/traffic_generated.h"

namespace reprise::world {

/// "No such lane, signal or neighbour" in the recorded nouns. Functions that
/// look something up return std::optional or a null pointer instead.
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Ids below this one are given by the scenario (1 is its first actor), from here on by the traffic
/// demand. Never reused within an episode.
inline constexpr std::uint32_t first_background_id = 1'000'000;

/// The next tick while the stages write it. Equal drafts seal to equal bytes: what must be sorted
/// (see world/*.fbs) is sorted by the stage that writes it.
struct TickDraft {
    TickT tick;
    TrafficT traffic;
};

/// A finished tick: what the renderer, the scripts, the drivers and the next step may see.
/// Borrowed: lives as long as the SealedTick or the TraceReader that it looks into.
struct TickView {
    const Tick* tick = nullptr;
    const Traffic* traffic = nullptr;

    std::uint64_t index() const { return tick->index(); }

    std::span<const VehicleState> vehicles() const;
    std::span<const WheelState> wheels() const;
    std::span<const PropState> props() const;
    std::span<const Door> doors() const;
    std::span<const Control> controls() const;
    std::span<const Measurement> measurements() const;
    std::span<const SignalColor> signals() const;
    std::span<const CarState> cars() const;
    std::span<const WalkerState> walkers() const;
    std::span<const Look> vehicle_looks() const;
    std::span<const Look> car_looks() const;
};

/// A finished tick's bytes: two FlatBuffers, /sim/tick and /sim/traffic. The bytes are the tick: a
/// trace stores them, and every reader - live or replayed - looks at them through the same view.
class SealedTick {
  public:
    SealedTick(flatbuffers::DetachedBuffer tick, flatbuffers::DetachedBuffer traffic)
        : tick_(std::move(tick)),
          traffic_(std::move(traffic)) {}

    TickView view() const { return {GetTick(tick_.data()), GetTraffic(traffic_.data())}; }

    std::span<const std::uint8_t> tick_bytes() const { return {tick_.data(), tick_.size()}; }

    std::span<const std::uint8_t> traffic_bytes() const {
        return {traffic_.data(), traffic_.size()};
    }

  private:
    flatbuffers::DetachedBuffer tick_;
    flatbuffers::DetachedBuffer traffic_;
};

/// Freezes a draft: fills digests.state from the stage digests and digests.chain from `previous`,
/// then packs. About 2 us with 100 cars.
SealedTick seal(TickDraft& draft, const Digest128& previous);

/// What an event says in one line for people: its text, and behind a colon its detail.
std::string to_line(const Event& event);
std::string to_line(const EventT& event);

/// How the detail of an event begins that says at the end of a run how bad a failed check became.
/// Its kind, check_failed, and its name are those of the failure.
inline constexpr std::string_view worst_prefix = "worst ";

bool tells_worst(const Event& event);

/// The state with this id, or null. The range must be sorted by id. O(log n).
const VehicleState* find(std::span<const VehicleState> vehicles, std::uint32_t id);
const CarState* find(std::span<const CarState> cars, std::uint32_t id);
const WalkerState* find(std::span<const WalkerState> walkers, std::uint32_t id);
const Measurement* find(std::span<const Measurement> measurements, std::uint32_t actor);
const Control* find(std::span<const Control> controls, std::uint32_t actor);
const Look* find(std::span<const Look> looks, std::uint32_t actor);
const PropState* find(std::span<const PropState> props, std::uint32_t id);

/// Paint or outfit of an actor: drawn once, from the seed and the id alone. Never 0, which stands
/// for "not recorded".
Look drawn_look(std::uint64_t seed, std::uint32_t actor);

/// Does the vehicle do what a scenario or another program says, rather than decide by itself? Then
/// its controls are inputs of the run.
inline bool takes_controls(Driver driver) {
    return driver == Driver::manual || driver == Driver::external;
}

/// A command to change lanes names one lane; that to keep the lane names `none`; that which lifts
/// it nothing at all.
inline bool names_lane(const CommandT& change_lane) {
    return !change_lane.lanes.empty() && change_lane.lanes.front() != none;
}

/// To the record's grid of `per_unit` steps a unit (see traffic.fbs), ties to the even step.
inline double rounded(double value, double per_unit) {
    return std::nearbyint(value * per_unit) / per_unit;
}

/// Seconds since the start of the episode, computed from the index: never added up.
inline double seconds(std::uint64_t tick, std::uint64_t step_ns) {
    return static_cast<double>(tick * step_ns) * 1e-9;
}

}  // namespace reprise::world
