#pragma once

#include <cstdint>

#include "kernel/doors.h"
#include "kernel/lamp_orders.h"
#include "kernel/pedestrians.h"
#include "kernel/physics/physics.h"
#include "kernel/roster.h"
#include "scripting/scenario.h"
#include "traffic/background.h"
#include "world/tick.h"

namespace reprise::kernel {

/// The digest of each stage: of what it keeps for later ticks and of what it wrote into this one.
/// Together they cover every value of the tick, so equal chains mean equal records; only the line
/// of the scenario that said something is left out, because it decides nothing. 5 us a tick with
/// 100 cars.
std::uint64_t digest_of(const scripting::Scenario& scenario, const world::TickDraft& next);
std::uint64_t digest_of(const Roster& roster,
                        const LampOrders& lamps,
                        const Doors& doors,
                        const world::TickDraft& next);
std::uint64_t digest_of(const traffic::Background& background, const world::TickDraft& next);
std::uint64_t digest_of(const Pedestrians& pedestrians, const world::TickDraft& next);
std::uint64_t digest_of(const Physics& physics, const world::TickDraft& next);

/// The measurements keep nothing. Covers the events of all stages, too.
std::uint64_t digest_of_measurements(const world::TickDraft& next);

}  // namespace reprise::kernel
