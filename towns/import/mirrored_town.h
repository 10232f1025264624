#pragma once

#include <string>

#include "towns/network/place.h"

namespace reprise::towns {

/// A network of right-hand traffic, in a mirror that stands on the x axis: one of left-hand
/// traffic, as netconvert itself makes them. Lanes know their roads of the map as before, where the
/// numbers of lanes have the other sign.
std::string mirrored_network(const std::string& network);

/// Its signal heads and signs.
void mirror_place(Place& place);

}  // namespace reprise::towns
