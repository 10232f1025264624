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

/// Which of a head's signals its main lamps show: that of the way straight on, or the first.
std::uint32_t main_signal(const world::TownT& town, const std::vector<std::uint32_t>& signals);

/// Appends a lamp housing with its pole and arm, in world coordinates less `origin`.
/// The lamps show the signal of the way straight on, or the first; a green arrow of its own beside
/// them shows when a turn is free, for each turn that has a signal of its own.
void add_signal_head(Mesh& mesh,
                     const world::TownT& town,
                     const world::SignalHeadT& head,
                     const Eigen::Vector3d& origin);

/// Appends pole and head of a signal of a town that has no heads, in world coordinates less
/// `origin`. Nothing where an earlier one of its lane has them.
void add_signal(Mesh& mesh,
                const world::TownT& town,
                std::uint32_t signal,
                const Eigen::Vector3d& origin);

}  // namespace reprise::render
