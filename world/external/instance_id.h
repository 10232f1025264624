#pragma once

#include <cstdint>

#include "world/tick.h"
#include "world/town_generated.h"

namespace reprise::world {

/// What stands in a town, numbered through in the order of the Town's own lists: the same in every
/// run there.
struct TownThings {
    explicit TownThings(const TownT& town)
        : drawn_buildings(town.buildings.size()),
          signals(drawn_buildings + town.drawn_buildings.size()),
          trees(signals + (town.heads.empty() ? town.signals.size() : town.heads.size())),
          props(trees + town.trees.size()),
          end(props + town.props.size()) {}

    // The first of each; buildings begin with 0. Signals: Town.heads where there are any.
    std::size_t drawn_buildings, signals, trees, props, end;
};

// The numbers that instance pictures hold. 0: road, ground, paint, sky. Behind the end of a range
// they begin again at its start, so that two things share a number: a town has 32768 things and
// more, a run 24576 actors of the background.
inline constexpr std::uint32_t first_background_instance = 0x2000;
inline constexpr std::uint32_t first_static_instance = 0x8000;

/// An actor's: of a scenario's its own id, of the background's counted from 8192.
inline constexpr std::uint16_t instance_of_actor(std::uint32_t actor) {
    if (actor == 0)
        return 0;
    if (actor < first_background_id)
        return static_cast<std::uint16_t>((actor - 1) % (first_background_instance - 1) + 1);
    return static_cast<std::uint16_t>(first_background_instance +
                                      (actor - first_background_id) %
                                          (first_static_instance - first_background_instance));
}

/// A town thing's, from 32768.
inline constexpr std::uint16_t instance_of_thing(std::size_t thing) {
    return static_cast<std::uint16_t>(first_static_instance + thing % first_static_instance);
}

}  // namespace reprise::world
