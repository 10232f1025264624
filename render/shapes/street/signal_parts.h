#pragma once

#include "render/shapes/mesh.h"
#include "world/town_generated.h"

namespace reprise::render {

// In these frames x is the driving direction of those who face a signal, y is to their left, the
// origin on the ground. A pole stands at x = signal_pole.
inline constexpr float signal_pole = 0.3F;

/// [m] the height of a case with its lamps.
float signal_case_height(bool for_walkers);

void add_signal_pole(Mesh& mesh, const Eigen::Isometry3f& frame, float y, float height);

/// One lamp with its visor; `at` is its middle.
void add_signal_lamp(Mesh& mesh,
                     const Eigen::Isometry3f& frame,
                     const Eigen::Vector3f& at,
                     float radius,
                     Finish lamp);

/// Three lamps for cars, two for walkers; `top` is the height of the case's upper edge.
void add_signal_case(Mesh& mesh,
                     const Eigen::Isometry3f& frame,
                     float y,
                     float top,
                     std::uint32_t signal,
                     bool for_walkers);

/// Appends the town's lamp housings with their poles and arms, in world coordinates less `origin`.
/// The lamps show the signal of the way straight on, or the first; a lamp of its own beside them
/// shows when a turn is free, for each turn that has a signal of its own.
void add_signal_heads(Mesh& mesh, const world::TownT& town, const Eigen::Vector3d& origin);

/// Appends poles and heads of every signal of a town that has no heads, in world coordinates less
/// `origin`.
void add_signals(Mesh& mesh, const world::TownT& town, const Eigen::Vector3d& origin);

}  // namespace reprise::render
