#include "cli/dataset/nuscenes_map.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ground/mesh/build_ground.h"
#include "render/map/road_mask.h"
#include "render/picture.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/models/actors.h"

namespace reprise::cli {

namespace {

constexpr double seen_around = 250;  // [m] that sensors look at around the way that was driven
constexpr double mask_pixel = 0.1;   // [m] of masks
constexpr double most_pixels = 1 << 30;

}  // namespace

std::vector<NuscenesMap> nuscenes_maps(const std::list<DatasetSource>& sources,
                                       const std::vector<DatasetFrame>& frames) {
    std::vector<NuscenesMap> maps;
    std::size_t number = 0;
    for (const DatasetSource& source : sources) {
        const world::EpisodeT& episode = source.trace().episode();
        const std::string town = world::to_hex(episode.town_digest);
        auto map = std::find_if(
            maps.begin(), maps.end(), [&](const NuscenesMap& one) { return one.town == town; });
        if (map == maps.end())
            map = maps.insert(maps.end(), {town, episode.town, {}, {}});
        map->traces.push_back(number);
        for (const DatasetFrame& frame : frames) {
            if (frame.trace != number)
                continue;
            const world::TickView tick = source.trace().tick(frame.tick).view;
            const auto pose = world::find_pose(tick, source.ego(tick));
            map->region.take(pose->translation().head<2>(), seen_around);
        }
        ++number;
    }
    for (NuscenesMap& map : maps) {
        map.region.low = map.region.low.array().floor();
        map.region.high = map.region.high.array().ceil();
        const Eigen::Vector2d size = map.region.high - map.region.low;
        if (size.prod() / mask_pixel / mask_pixel > most_pixels)
            throw world::Error(
                fmt::format("the map of {} around these drives is {:.1f} km by {:.1f} km, where "
                            "nuScenes' masks "
                            "of 0.1 m have an end at 10 square km: say fewer traces or --ticks",
                            map.name,
                            size.x() / 1000,
                            size.y() / 1000));
    }
    return maps;
}

const NuscenesMap& map_of(const std::vector<NuscenesMap>& maps, std::size_t trace) {
    for (const NuscenesMap& map : maps)
        if (std::find(map.traces.begin(), map.traces.end(), trace) != map.traces.end())
            return map;
    REPRISE_CHECK(false, std::to_string(trace));
    return maps.front();
}

void write_nuscenes_mask(const NuscenesMap& map,
                         const world::TownT& town,
                         const std::filesystem::path& path) {
    render::write_png(render::road_mask(ground::build_ground(town), map.region, mask_pixel),
                      path,
                      render::Texture::flat);
}

}  // namespace reprise::cli
