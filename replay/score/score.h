#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "replay/score/infraction.h"
#include "replay/trace_reader.h"

namespace reprise::replay {

/// How far a vehicle came on the way that it was told last.
struct RouteScore {
    double length = 0;             ///< [m]
    double completion = 0;         ///< in [0, 1]
    std::uint64_t told_at = 0;     ///< tick
    std::uint64_t arrived_at = 0;  ///< tick; 0: it did not

    /// As a driving score counts it: all of it from 99 % on, where no more than 10 m are left.
    double counted() const;
};

/// The Leaderboard ends a route when the vehicle is blocked for three minutes.
struct RouteEnd {
    std::uint64_t tick = 0;
    double driven = 0;    ///< [m] until then
    double off_lane = 0;  ///< [m] of them
};

/// What a vehicle with mass did.
struct VehicleScore {
    std::uint32_t id = 0;
    std::string name;  ///< as the scenario spawned it; "" when that is not in the trace
    std::string model;
    std::uint64_t ticks = 0;
    double driven = 0;                      ///< [m]
    double off_lane = 0;                    ///< [m] of them with most of it on no lane of its way
    std::optional<RouteEnd> ended;          ///< what comes behind it is in no driving score
    std::optional<RouteScore> route;        ///< none: it was told none, or none that leads anywhere
    std::vector<Infraction> infractions{};  ///< by first tick, then kind

    /// Of a kind: how often by the paper's rule, and in how many episodes.
    std::uint64_t count(InfractionKind kind, std::uint64_t step_ns) const;
    std::uint64_t episodes(InfractionKind kind) const;

    /// The one with the largest `worst`, or null.
    const Infraction* worst(InfractionKind kind) const;
};

/// A function of the trace alone: any run can be scored, however old. Of who drives with mass, by
/// id, or of one. Reads all ticks, about 20 us each and 10 for each vehicle. Throws world::Error
/// for a trace whose level leaves states out.
std::vector<VehicleScore> score(TraceReader& trace, std::optional<std::uint32_t> actor = {});

}  // namespace reprise::replay
