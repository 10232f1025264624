// Private to the room: elements of the document are handed around.
#pragma once

#include "towns/network/junction_links.h"

namespace reprise::towns {

inline constexpr double shortest_green = 6;  ///< [s] that anybody is given

/// Somebody's green, in a program of netconvert; shorter phases clear the junction behind it.
bool is_green(pugi::xml_node phase);

/// Programs of netconvert for several junctions at once give each of their roads a green of its
/// own, also where nobody meets: at different junctions, mostly. Who meets nobody then gets green
/// together, and the cycle takes 90 s, with greens of at least 6 s. Roads that had green together
/// still do; nobody who meets gets it who had not. False: nothing can be united, and the program
/// keeps every byte.
bool unite_greens(pugi::xml_node program, pugi::xml_node net, const JunctionLinks& links);

}  // namespace reprise::towns
