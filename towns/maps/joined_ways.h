#pragma once

#include <cstdint>
#include <vector>

namespace reprise::towns {

/// Nodes of a way, by their ids in OpenStreetMap. A ring ends with the node that it begins with.
using NodeIds = std::vector<std::int64_t>;

struct JoinedWays {
    std::vector<NodeIds> rings;  ///< in the order of the first of their ways
    bool all_close = true;       ///< false when a way is part of no ring
};

/// Joins ways end to end, in either direction, to rings. None is null, has less than two nodes or
/// is a ring by itself. Rings that touch where ways end come apart. O(n log n) of the ways.
JoinedWays join_ways(const std::vector<const NodeIds*>& ways);

}  // namespace reprise::towns
