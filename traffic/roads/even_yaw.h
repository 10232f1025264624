#pragma once

#include "world/town.h"

namespace reprise::traffic {

/// The lane's direction at s, turning evenly where its centre line has a corner: who is aside of
/// the line would be thrown back or forward there, by the corner's angle times how far aside it is.
double even_yaw_at(const world::LaneT& lane, double s);

}  // namespace reprise::traffic
