#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scripting/run/actors.h"
#include "world/lanes/route.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::scripting {

/// Somebody in a tick, whoever put him there.
struct Neighbour {
    enum class Kind : std::uint8_t { vehicle, bicycle, walker, prop };

    Body body;
    std::uint32_t id = 0;
    std::uint16_t model = 0;  ///< in the catalogue of his kind
    Kind kind = Kind::vehicle;
};

/// "vehicle", ...
const char* name_of(Neighbour::Kind kind);

/// Of the catalogue: "sedan".
const char* model_name(const Neighbour& neighbour);

/// Everybody in a tick: vehicles with mass, cars, walkers, each by id. O(all), 20 ns each.
std::vector<Neighbour> everybody(const world::TickView& tick);

/// How many they are.
std::size_t count_everybody(const world::TickView& tick);

/// Who is in the way of a vehicle that goes on along its lane where it is in it.
struct InTheWay {
    double gap = 0;  ///< [m] from its front bumper to him, not below 0
    Neighbour who;
};

/// What must it do?   Find whoever stands or drives in the strip that the vehicle will cover: as
/// wide
///                    as it is, along the centre line of its lane and those behind it, as far aside
///                    of it as the vehicle is now, up to `range` metres ahead of its bumper.
/// What does it assume? `body.lane` names its lane; off every lane the strip goes straight ahead.
/// How?               Where lanes part it follows `route` (lanes to come), else the way with the
///                    least turn. Boxes are measured by their shadows along and across the lane.
std::optional<InTheWay> find_ahead(const world::TownT& town,
                                   const world::TickView& tick,
                                   const Body& body,
                                   std::uint32_t id,
                                   std::span<const world::Route::Piece> route,
                                   double range);

}  // namespace reprise::scripting
