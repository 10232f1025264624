#pragma once

#include "ground/mesh/ground_builder.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// How thick a bridge is. [m]
inline constexpr double deck_depth = 0.8;

/// What is this much over what is below it is a bridge; less is an embankment's edge. [m]
inline constexpr double hanging = 1.5;

/// Roads beside each other differ by less. [m]
inline constexpr double beside_step = 0.3;

/// Sides and undersides (Surface::deck) for all roads and sidewalks in `ground` that hang more than
/// 1.5 m over what is under them, the terrain included. Nothing in a flat town.
void add_decks(const world::TownT& town, GroundBuilder& ground);

}  // namespace reprise::ground
