#pragma once

#include "world/tick.h"

namespace reprise::kernel {

/// Cars without mass against walkers: traffic's cars brake as well as they can, and whoever steps
/// out closer than that is hit. Raises `collision` (actor: the car, other: the walker; value: the
/// impulse of a plastic hit, as physics takes it for vehicles with mass) in the first tick of the
/// touch, and `collision_ended` in the next one: by then the walker lies (see Pedestrians), and who
/// lies is not hit again. A bus that turns hits with its tail as well. A walker who bumps into a
/// car that stands is no event. A pure function of two ticks; about 0.1 us a walker.
void note_hit_walkers(double step_seconds, const world::TickView& last, world::TickDraft& next);

}  // namespace reprise::kernel
