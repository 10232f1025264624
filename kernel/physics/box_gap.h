#pragma once

#include "kernel/physics/bullet.h"

namespace reprise::kernel {

/// A box anywhere: its middle, and half of its length, width and height.
struct PlacedBox {
    btTransform pose;
    btVector3 half;
};

/// How far two boxes are apart, as the largest gap along any of the 15 axes that can tell two boxes
/// apart (S. Gottschalk et al., "OBBTree", SIGGRAPH 1996): never more than the true distance.
/// Negative where they reach into each other. [m]
double gap_between(const PlacedBox& one, const PlacedBox& other);

}  // namespace reprise::kernel
