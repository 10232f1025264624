#pragma once

#include <cstdint>
#include <span>

#include "traffic/cars/car.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

// Who goes nowhere, which nobody else will solve: SUMO's drivers do not back off. `step` [s] of a
// tick, `tick` the index of the last one.

/// Has it stood for minutes for another car, in whose way it stands itself, perhaps?
bool waits_for_ever(const Car& car, double step);

/// Has it stood for long at the flank of a vehicle with mass, which it must not hit and which
/// waits for it, perhaps? SUMO knows of no such waiting.
bool is_wedged(const Car& car, double step, std::uint64_t tick);

/// Has it stood for long at the end of a lane that leads nowhere, and found no gap beside?
bool is_at_an_end(const Car& car, double step, const world::TownT& town);

/// Has it stood for long nose to nose with a vehicle with mass that stands, as in a bend in
/// which neither can get past the other?
bool faces_one_who_stands(const Car& car, double step, const world::TickView& last);

/// Has it stood in a junction with a corner in another one who stands, or for long on a road in one
/// who comes towards it? Of two such only who has stood longer, or the lower id. Looks in every
/// 20th tick of its standing: at other times false.
bool lies_in_one_who_stands(const Car& car,
                            std::span<const Car> cars,
                            double step,
                            const world::TownT& town);

}  // namespace reprise::traffic
