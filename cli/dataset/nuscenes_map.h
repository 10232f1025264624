#pragma once

#include <list>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "cli/dataset/dataset_source.h"
#include "cli/dataset/frame_list.h"
#include "world/geometry2d.h"

namespace reprise::cli {

/// The part of a town that traces of a data set drive through. nuScenes counts from its south-west
/// corner, so that all places are positive and a mask of it needs no place of its own.
struct NuscenesMap {
    std::string town;                 ///< digest of its network
    std::string name;                 ///< for people
    std::vector<std::size_t> traces;  ///< by their index
    world::Box region;                ///< [m] in our world; its corners are whole metres

    Eigen::Vector3d origin() const { return {region.low.x(), region.low.y(), 0}; }
};

/// One for each town, in the order of the traces. Throws world::Error where one is too large.
std::vector<NuscenesMap> nuscenes_maps(const std::list<DatasetSource>& sources,
                                       const std::vector<DatasetFrame>& frames);

const NuscenesMap& map_of(const std::vector<NuscenesMap>& maps, std::size_t trace);

/// Its mask: roads and sidewalks, ten pixels a metre, as the devkit takes for granted.
void write_nuscenes_mask(const NuscenesMap& map,
                         const world::TownT& town,
                         const std::filesystem::path& path);

}  // namespace reprise::cli
