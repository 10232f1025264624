#include "ground/mesh/junction_surface.h"

namespace reprise::ground {

bool is_inside_junction(const world::TownT& town, const world::LaneT& lane) {
    const bool is_path = lane.kind == world::LaneKind::internal ||
                         (lane.kind == world::LaneKind::other && lane.edge.starts_with(':'));
    return is_path && lane.junction < town.junctions.size();
}

std::vector<JunctionParts> parts_of_junctions(const world::TownT& town) {
    std::vector<JunctionParts> parts(town.junctions.size());
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        if (is_inside_junction(town, lane))
            parts[lane.junction].paths.push_back(i);
        if (lane.kind == world::LaneKind::crossing && lane.junction < parts.size())
            parts[lane.junction].crossings.push_back(i);
    }
    return parts;
}

SurfaceHeight height_of_junction(const world::TownT& town,
                                 std::uint32_t junction,
                                 const JunctionParts& parts) {
    std::vector<std::vector<world::Vec3>> lines;
    for (const std::uint32_t path : parts.paths)
        lines.push_back(town.lanes[path].centre);
    // Only cars care to the centimetre; without paths the outline and the crossings must do.
    if (lines.empty())
        lines.push_back(town.junctions[junction].outline);
    if (parts.paths.empty())
        for (const std::uint32_t crossing : parts.crossings)
            lines.push_back(town.lanes[crossing].centre);
    return SurfaceHeight(lines);
}

}  // namespace reprise::ground
