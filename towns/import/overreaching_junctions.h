#pragma once

#include <string>
#include <vector>

namespace reprise::towns {

/// Ids of the map's junctions that are to become one.
using JunctionIds = std::vector<std::string>;

/// How many junctions became part of another.
std::size_t merges_in(const std::vector<JunctionIds>& joins);

/// The joins that netconvert wrote (--junctions.join-output); none in a file that is none.
std::vector<JunctionIds> read_joins(const std::string& xml);

/// As netconvert reads them again (--node-files).
std::string joins_xml(const std::vector<JunctionIds>& joins);

/// Joins by which `network` was made, and those that it lacks: where a junction reaches over the
/// next one, as in cities whose footways cross close to it, a road between them would end before it
/// begins, and cars would turn round on the spot. Each is joined with the junction at the other end
/// of that road. Returns `joins` where nothing is to be joined.
std::vector<JunctionIds> with_overreaching(std::vector<JunctionIds> joins,
                                           const std::string& network);

}  // namespace reprise::towns
