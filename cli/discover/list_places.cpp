#include "cli/discover/list_places.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/town/towns.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/lanes/density.h"
#include "world/lanes/road_place.h"
#include "world/town.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Cell = Sheet::Cell;
using world::LaneKind;
using world::LaneT;

const char* kind_name(LaneKind kind) {
    switch (kind) {
        case LaneKind::driving:
            return "driving";
        case LaneKind::internal:
            return "in a junction";
        case LaneKind::sidewalk:
            return "sidewalk";
        case LaneKind::crossing:
            return "crossing";
        case LaneKind::walking_area:
            return "walking area";
        case LaneKind::other:
            break;
    }
    return "not for cars";
}

Cell lane_name(const world::TownT& town, std::uint32_t lane) {
    return lane == world::none ? Cell{} : Cell{town.lanes[lane].name};
}

/// One id, or several in the order in which one drives through them.
std::string roads_of(const std::vector<world::RoadPiece>& pieces) {
    std::string text;
    for (const world::RoadPiece& piece : pieces)
        text += (text.empty() ? "" : " ") + piece.road;
    return text;
}

Cell limit_kmh(const LaneT& lane) {
    return world::is_for_cars(lane) ? Cell{lane.speed_limit * 3.6} : Cell{};
}

/// What its first lines say, up to the first full stop.
std::string first_words(const std::string& source) {
    std::string text;
    for (std::size_t at = 0; source.compare(at, 2, "--") == 0;) {
        const std::size_t end = std::min(source.find('\n', at), source.size());
        const std::size_t start = std::min(source.find_first_not_of("- ", at), end);
        text += (text.empty() ? "" : " ") + source.substr(start, end - start);
        at = std::min(end + 1, source.size());
    }
    return text.substr(0, text.find(". "));
}

std::vector<Cell> scenario_row(const fs::path& path) {
    const std::string shown = path.lexically_normal().string();
    try {
        const world::EpisodeT episode = scripting::load_episode(path, {});
        std::vector<std::string> parameters;
        for (const world::ParameterT& parameter : episode.parameters)
            parameters.push_back(parameter.key + " = " + parameter.value);
        return {episode.name,
                shown,
                episode.town,
                static_cast<double>(episode.max_ticks * episode.step_ns) * 1e-9,
                episode.cars == world::auto_cars ? Cell{"auto"}
                                                 : Cell{static_cast<std::int64_t>(episode.cars)},
                fmt::format("{}", fmt::join(parameters, ", ")),
                first_words(episode.scenario)};
    } catch (const world::Error& error) {
        return {Cell{},
                shown,
                Cell{},
                Cell{},
                Cell{},
                Cell{},
                "does not load: " + std::string(error.what())};
    }
}

}  // namespace

Sheet town_sheet() {
    Sheet sheet({{"town", "name"},
                 {"roads [km]", "road_length"},
                 {"lanes", "driving_lanes"},
                 {"junctions", "junctions"},
                 {"lit", "lit_junctions"},
                 {"limits [km/h]", "limits_kmh"},
                 {"longest lane [m]", "longest_lane", 0},
                 {"path", "path"}});
    for (const NamedTown& named : named_towns()) {
        try {
            const world::TownT town = towns::read_town(towns::load_network(named.network));
            std::set<std::string> edges;
            double roads = 0;
            double longest = 0;
            std::int64_t lanes = 0;
            std::set<int> limits;
            for (const LaneT& lane : town.lanes) {
                if (lane.kind != LaneKind::driving)
                    continue;
                ++lanes;
                longest = std::max(longest, lane.length);
                limits.insert(static_cast<int>(std::lround(lane.speed_limit * 3.6)));
                // Both directions of a road are one road.
                const bool counted = lane.opposite != world::none &&
                                     edges.count(town.lanes[lane.opposite].edge) != 0;
                if (edges.insert(lane.edge).second && !counted)
                    roads += lane.length;
            }
            const auto lit = std::count_if(town.junctions.begin(),
                                           town.junctions.end(),
                                           [](const auto& junction) { return junction.lit; });
            sheet.add({named.name,
                       roads / 1000,
                       lanes,
                       static_cast<std::int64_t>(town.junctions.size()),
                       static_cast<std::int64_t>(lit),
                       fmt::format("{}", fmt::join(limits, ", ")),
                       longest,
                       named.network.string()});
        } catch (const world::Error& error) {
            sheet.add({named.name, Cell{}, Cell{}, Cell{}, Cell{}, Cell{}, Cell{}, error.what()});
        }
    }
    return sheet;
}

Sheet lane_sheet(const std::string& town_name, bool all) {
    Sheet sheet({{"lane", "name"},
                 {"edge", "edge"},
                 {"kind", "kind"},
                 {"length [m]", "length"},
                 {"width [m]", "width"},
                 {"limit [km/h]", "limit_kmh", 0},
                 {"left", "left"},
                 {"right", "right"},
                 {"opposite", "opposite"},
                 {"street", "street"},
                 {"road", "road"},
                 {"its lane", "road_lane"},
                 {"from s [m]", "road_s"},
                 {"to s [m]", "road_s_end"}});
    const world::TownT town = towns::read_town(load_town(town_name));
    for (const LaneT& lane : town.lanes) {
        const bool in_a_junction = lane.edge.starts_with(':');
        if (in_a_junction && !all)
            continue;
        const std::vector<world::RoadPiece> roads = world::road_pieces(lane);
        sheet.add({lane.name,
                   lane.edge,
                   kind_name(lane.kind),
                   lane.length,
                   lane.width,
                   limit_kmh(lane),
                   lane_name(town, lane.left),
                   lane_name(town, lane.right),
                   lane_name(town, lane.opposite),
                   lane.street,
                   roads.empty() ? Cell{} : Cell{roads_of(roads)},
                   roads.empty() ? Cell{} : Cell{std::int64_t{lane.road_lane}},
                   roads.empty() ? Cell{} : Cell{lane.road_s},
                   roads.empty() ? Cell{} : Cell{lane.road_s_end}});
    }
    return sheet;
}

Sheet scenario_sheet() {
    Sheet sheet({{"scenario", "name"},
                 {"file", "path"},
                 {"town", "town"},
                 {"limit [s]", "duration", 0},
                 {"cars", "cars"},
                 {"parameters", "parameters"},
                 {"", "about"}});
    std::set<fs::path> seen;
    for (const fs::path& folder : scenario_folders()) {
        std::vector<fs::path> files;
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder, ignored))
            if (entry.path().extension() == ".lua" && !entry.path().stem().string().ends_with(".d"))
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files)
            if (seen.insert(fs::weakly_canonical(file, ignored)).second)
                sheet.add(scenario_row(file));
    }
    return sheet;
}

}  // namespace reprise::cli
