#pragma once

#include <cstddef>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Who has to wait inside a junction waits clear of the ways of those whom he lets pass. netconvert
/// puts that place (an internal junction) where the centre lines come close, as if cars had no
/// width: a waiting nose then stands in the way of others by a metre and more. Here the first part
/// of such a path ends as much earlier as it takes, and its second part begins there. Changes
/// nothing where nothing is to be had within a few metres; done twice, nothing is left to do.
/// Returns how many places were moved.
std::size_t move_waiting_places(pugi::xml_node net);

}  // namespace reprise::towns
