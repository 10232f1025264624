#include "cli/town/town_show.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "cli/town/towns.h"
#include "ground/mesh/build_ground.h"
#include "ground/paint/markings.h"
#include "render/map/town_map.h"
#include "render/picture.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

world::Box region_of(const std::vector<double>& numbers) {
    world::Box region;
    if (numbers.empty())
        return region;
    const bool finite = std::all_of(
        numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
    if (numbers.size() != 4 || !finite)
        throw world::Error(
            "--region: expected four numbers: x and y of the south-west corner, width and height "
            "in metres, such as 0,150,80,60");
    const Eigen::Vector2d corner(numbers[0], numbers[1]);
    const Eigen::Vector2d size(numbers[2], numbers[3]);
    constexpr double least = 10;  // [m]
    if (!(size.minCoeff() >= least))
        throw world::Error(
            fmt::format("--region: {:g} x {:g} m is too small; at least {:g} m each way",
                        size.x(),
                        size.y(),
                        least));
    region.take(corner);
    region.take(corner + size);
    return region;
}

void require_some_town(const world::Box& region, const world::TownT& town) {
    const Eigen::Vector2d low = world::in_plan(town.low);
    const Eigen::Vector2d high = world::in_plan(town.high);
    const bool apart = region.low.x() > high.x() || region.low.y() > high.y() ||
                       region.high.x() < low.x() || region.high.y() < low.y();
    if (!region.empty() && apart)
        throw world::Error(
            fmt::format("--region: nothing of {} is there; it lies between ({:.0f}, {:.0f}) and "
                        "({:.0f}, {:.0f})",
                        town.name,
                        low.x(),
                        low.y(),
                        high.x(),
                        high.y()));
}

}  // namespace

int town_show(const TownShowOptions& options) {
    const world::Box region = region_of(options.region);
    const world::TownT town = towns::read_town(load_town(options.town));
    require_some_town(region, town);
    const world::SensorFrame map = render::town_map(
        town, ground::build_ground(town), ground::build_markings(town), {region, options.size});
    render::write_png(map, options.output, render::Texture::flat);
    say("{}: {} x {} pixels\n", options.output, map.width, map.height);
    return exit_good;
}

}  // namespace reprise::cli
