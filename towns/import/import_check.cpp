#include "towns/import/import_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "files/output_file.h"
#include "towns/maps/netconvert.h"
#include "towns/town_reader.h"
#include "world/check.h"

namespace reprise::towns {

namespace {

namespace fs = std::filesystem;
using world::LaneKind;

constexpr const char* tried = "tried.net.xml";

double kilometres(const world::TownT& town, LaneKind kind) {
    double length = 0;
    for (const world::LaneT& lane : town.lanes)
        length += lane.kind == kind ? lane.length : 0;
    return length / 1000;
}

auto count(const world::TownT& town, LaneKind kind) {
    return std::count_if(town.lanes.begin(), town.lanes.end(), [kind](const world::LaneT& lane) {
        return lane.kind == kind;
    });
}

/// SUMO is not at ease with them (see Mirrors::enter_again): worth knowing.
std::string tiny_lanes(const world::TownT& town) {
    constexpr double tiny = 1;  // [m]
    const auto number =
        std::count_if(town.lanes.begin(), town.lanes.end(), [](const world::LaneT& lane) {
            return lane.kind == LaneKind::driving && lane.sumo_length < tiny;
        });
    return number == 0 ? "" : fmt::format("lanes for cars shorter than 1 m: {}\n", number);
}

std::string summary(const world::TownT& town) {
    const auto lit = std::count_if(town.junctions.begin(),
                                   town.junctions.end(),
                                   [](const world::JunctionT& junction) { return junction.lit; });
    return fmt::format(
        "lanes for cars: {}, {:.2f} km; sidewalks: {}, {:.2f} km; crossings: {}\n"
        "junctions: {}, {} of them lit\n"
        "size: {:.0f} m x {:.0f} m, heights {:.1f} to {:.1f} m\n",
        count(town, LaneKind::driving),
        kilometres(town, LaneKind::driving),
        count(town, LaneKind::sidewalk),
        kilometres(town, LaneKind::sidewalk),
        count(town, LaneKind::crossing),
        town.junctions.size(),
        lit,
        town.high.x() - town.low.x(),
        town.high.y() - town.low.y(),
        town.low.z(),
        town.high.z());
}

/// Reads what was written, as a run will do. Returns its summary.
std::string read_again(const fs::path& path, const std::string& map) {
    try {
        const world::TownT town = read_town(load_network(path));
        return summary(town) + tiny_lanes(town);
    } catch (const world::Error& error) {
        std::string what = error.what();
        if (what.starts_with(path.parent_path().string()))  // which is gone when this is read
            what = map + ": what came out of it is no town: " +
                   what.substr(std::min(what.find(": ") + 2, what.size()));
        throw world::Error(what);
    }
}

/// SUMO itself must load what came out: a network of a newer SUMO may hold things that only the
/// simulation minds, and a run would end over them. `name`: of the network in `work`, where names
/// hold no commas.
void try_in_sumo(const std::string& name, const fs::path& work, const std::string& map) {
    run_sumo_tool("sumo",
                  {"--net-file",
                   name,
                   "--end",
                   "0",
                   "--no-step-log",
                   "--no-warnings",
                   "--duration-log.disable",
                   "--xml-validation.net",
                   "never"},
                  work,
                  map);
}

}  // namespace

std::string check_import(const fs::path& network, const fs::path& work, const std::string& map) {
    const std::string summary = read_again(network, map);
    fs::copy_file(network, work / tried);
    try_in_sumo(tried, work, map);
    return summary;
}

void require_sumo_takes(const std::string& network, const fs::path& work, const std::string& map) {
    files::write_file(work / tried, "the network", network);
    try_in_sumo(tried, work, map);
}

}  // namespace reprise::towns
