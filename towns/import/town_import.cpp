// What it must do: make a town of a map, and say what was done, changed and lost.
// What it assumes: netconvert's exit code means little: what it wrote is looked at.
// How it goes: copy the map into a work folder; netconvert; read out of the map what netconvert
// does
//   not take over; write; read the result as any town is read.
// What it keeps: nothing; all files lie in the folder.
#include "towns/import/town_import.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files/output_place.h"
#include "towns/bridges/guessed_bridges.h"
#include "towns/bridges/raise_roads.h"
#include "towns/import/footprints.h"
#include "towns/import/guessed_crossings.h"
#include "towns/import/import_check.h"
#include "towns/import/map_signs.h"
#include "towns/import/mirrored_town.h"
#include "towns/import/overreaching_junctions.h"
#include "towns/import/right_of_way.h"
#include "towns/import/road_ids.h"
#include "towns/import/signal_cycles.h"
#include "towns/import/signal_sites.h"
#include "towns/import/stubs.h"
#include "towns/maps/map_source.h"
#include "towns/maps/netconvert.h"
#include "towns/maps/opendrive.h"
#include "towns/maps/openstreetmap_check.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::towns {

namespace {

namespace fs = std::filesystem;
using world::LaneKind;

constexpr const char* made = "made.net.xml";    ///< in the work folder
constexpr const char* joins = "joins.nod.xml";  ///< netconvert's own, there
constexpr std::uintmax_t room = 1 << 20;  ///< [bytes] of a disk with less it is said to be full

std::string read_text(const fs::path& path) {
    std::ostringstream text;
    std::ifstream file(path, std::ios::binary);
    if (file.peek() != std::ifstream::traits_type::eof())
        text << file.rdbuf();
    if (!file)
        throw world::Error(path.string() + ": cannot be read");
    return std::move(text).str();
}

void write_text(const fs::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file)
        throw world::Error(path.string() + ": cannot be written: " + files::write_error(errno));
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// netconvert writes the date and its command line into a comment.
std::string without_comments(const std::string& xml) {
    std::string kept;
    for (std::size_t from = 0; from < xml.size();) {
        const std::size_t start = std::min(xml.find("<!--", from), xml.size());
        kept.append(xml, from, start - from);
        const std::size_t end = xml.find("-->", start);
        from = start == xml.size() || end == std::string::npos ? xml.size() : end + 3;
        if (start < xml.size())
            from = std::min(xml.find_first_not_of("\r\n", from), xml.size());
    }
    return kept;
}

/// netconvert escapes the names of OpenStreetMap's streets twice.
void escape_once(std::string& xml) {
    for (const std::string_view entity : {"lt;", "gt;", "quot;", "apos;", "amp;"})
        replace_all(xml, fmt::format("&amp;{}", entity), fmt::format("&{}", entity));
}

/// One import on its way.
class Import {
  public:
    Import(const TownImport& wish, const fs::path& work)
        : work_(work),
          map_(wish.map.string()),
          source_(open_map(wish.map, work)) {
        if (wish.left_hand && source_.kind != MapKind::openstreetmap)
            throw world::Error(map_ + ": --lefthand is for OpenStreetMap; this map says so itself");
        switch (source_.kind) {
            case MapKind::opendrive:
                from_opendrive(wish);
                break;
            case MapKind::openstreetmap:
                from_openstreetmap(wish);
                break;
            case MapKind::network:
                from_network(wish);
                break;
        }
    }

    std::string network;
    std::string place;
    std::string report;

    const std::string& map_name() const { return source_.name; }

  private:
    template <typename... Values>
    void say(fmt::format_string<Values...> text, Values&&... values) {
        report += fmt::format(text, std::forward<Values>(values)...) + "\n";
    }

    template <typename Number>
    static std::string count(Number number, std::string_view word, std::string_view plural = {}) {
        return world::count_of(static_cast<std::uint64_t>(number), word, plural);
    }

    /// Runs netconvert; the network it made is in the file `made` and in `network`.
    void convert(std::vector<std::string> words) {
        if (const int warnings = run_netconvert(std::move(words)); warnings > 0)
            say("netconvert gave {}", count(warnings, "warning"));
    }

    int run_netconvert(std::vector<std::string> words) {
        words.insert(words.end(),
                     {"--output.street-names", "--precision", "3", "--output-file", made});
        const int warnings = run_sumo_tool("netconvert", std::move(words), work_, map_);
        if (!fs::exists(work_ / made))
            throw world::Error(map_ + ": netconvert made no network of it");
        network = without_comments(read_text(work_ / made));
        // netconvert does not look whether its output could be written.
        if (network.find("</net>") == std::string::npos && fs::space(work_).available < room)
            throw world::Error(work_.parent_path().string() + ": cannot be written: no space left");
        escape_once(network);
        return warnings;
    }

    /// The same again, without the crossings that netconvert only guesses where no roads meet.
    void take_back_crossings(std::vector<std::string> words,
                             const std::vector<Eigen::Vector3d>& mapped) {
        const GuessedCrossings guessed = guessed_crossings(network, mapped);
        if (guessed.at_joins == 0)
            return;
        write_text(work_ / "crossings.con.xml", guessed.connections);
        words.insert(words.end(), {"--connection-files", "crossings.con.xml"});
        run_netconvert(std::move(words));
    }

    /// Until no junction reaches over the next one; `words` then make what there is.
    void join_overreaching(std::vector<std::string>& words) {
        constexpr int most_rounds = 8;  // a city of 30 km of lanes takes 4
        const fs::path told = work_ / joins;
        std::vector<JunctionIds> now =
            fs::exists(told) ? read_joins(read_text(told)) : std::vector<JunctionIds>();
        const std::size_t merges = merges_in(now);
        for (int round = 0; round < most_rounds; ++round) {
            const std::vector<JunctionIds> more = with_overreaching(now, network);
            if (more == now)
                break;
            write_text(work_ / "joined.nod.xml", joins_xml(more));
            std::vector<std::string> joined = words;
            if (round == 0) {
                std::erase(joined, "--junctions.join");
                joined.insert(joined.end(), {"--node-files", "joined.nod.xml"});
            }
            run_netconvert(joined);
            words = std::move(joined);
            now = more;
        }
        if (const std::size_t joined = merges_in(now) - merges; joined > 0)
            say("junctions: {} reached over the next one and became one with it", joined);
    }

    /// Two rounds: behind a stub there may have been another.
    void drop_stubs() {
        std::size_t dropped = 0;
        for (int round = 0; round < 2; ++round) {
            const std::vector<std::string> ids = stubs(network);
            if (ids.empty())
                break;
            dropped += ids.size();
            write_text(work_ / "with_stubs.net.xml", network);
            run_netconvert({"--sumo-net-file",
                            "with_stubs.net.xml",
                            "--offset.disable-normalization",
                            "--no-turnarounds.except-deadend",
                            "--remove-edges.explicit",
                            fmt::format("{}", fmt::join(ids, ",")),
                            "--output.original-names"});
        }
        if (dropped > 0)
            say("roads: {} of less than 8 m that lead nowhere were left out", dropped);
    }

    void shorten_signal_cycles() {
        if (const ShortenedCycles cycles = shorten_cycles(network); cycles.programs > 0)
            say("signals: {} took up to {:.0f} s for a cycle; roads that do not meet have green "
                "together now, for a cycle of at most 120 s, or greens of 6 s",
                count(cycles.programs, "program"),
                cycles.longest);
    }

    void count_crossings(const std::vector<Eigen::Vector3d>& mapped) {
        if (const int lost = lost_crossings(read_roads(network, map_).town, mapped); lost > 0)
            say("lost: {} between junctions or without sidewalks", count(lost, "crossing"));
    }

    void guess_sidewalks(std::vector<std::string>& words) {
        words.emplace_back("--sidewalks.guess");
        // netconvert's own bounds: 5.8 and 13.89 m/s.
        say("sidewalks: added along roads with limits of 21 to 50 km/h that had none");
    }

    void from_opendrive(const TownImport& wish) {
        const OpenDrive map = read_opendrive(read_text(source_.file), map_);
        write_text(work_ / "map.xodr", map.prepared);
        say("OpenDRIVE {}", map.version);
        if (map.left_hand)
            say("traffic drives on the left");
        std::vector<std::string> words = opendrive_words("map.xodr");
        // Each lane says which of the map's it was made of.
        words.emplace_back("--output.original-names");
        if (wish.guess_sidewalks)
            guess_sidewalks(words);
        convert(words);
        const std::vector<Eigen::Vector3d> crossings = crossings_of(map);
        take_back_crossings(words, crossings);
        if (map.limits_set > 0)
            say("speed limits: {} got that of the road, which netconvert ignores",
                count(map.limits_set, "lane"));
        obey_signs([&](const ImportedRoads& roads) { return lane_signs(map, roads); });
        RoadIds ids = add_road_ids(network, read_roads(network, map_), map);
        network = std::move(ids.network);
        say("road ids: {} lanes know their road of the map, its lane and where along it they lie{}",
            ids.lanes,
            ids.unknown > 0 ? fmt::format("; {} do not", ids.unknown) : "");
        Place found;
        const SignalReport signals = place_signals(map, read_roads(network, map_), found);
        say("signals: {} in the map, {} placed as it says; signs: {} placed",
            signals.lights,
            count(signals.heads, "head"),
            signals.signs);
        if (signals.moved > 0)
            say("poles: {} would stand on a road and were moved to its edge, where heads get an "
                "arm",
                signals.moved);
        if (signals.shared > 0)
            say("signals: {} stand beside another one, whose head shows what they would",
                signals.shared);
        if (signals.lost > 0)
            say("lost: signals and signs that control nothing or have no place: {}", signals.lost);
        if (map.other_signs > 0)
            say("lost: signals and signs of other kinds: {}", map.other_signs);
        if (map.banked > 0)
            say("lost: the superelevation of {}, now flat from side to side",
                count(map.banked, "road"));
        count_crossings(crossings);
        say("lost: road markings and objects (they are made anew)");
        if (map.left_hand) {
            network = mirrored_network(network);
            mirror_place(found);
        }
        place = place_xml(found);
    }

    /// In the network's coordinates.
    std::vector<Eigen::Vector3d> crossings_of(const OpenDrive& map) const {
        std::vector<Eigen::Vector3d> crossings = map.crossings;
        const Eigen::Vector2d offset = offset_of(map, read_roads(network, map_));
        for (Eigen::Vector3d& crossing : crossings)
            crossing.head<2>() += offset;
        return crossings;
    }

    /// netconvert knows no signs: it is called once more, with what they mean.
    template <typename FindSigns>
    void obey_signs(const FindSigns& find_signs) {
        const ImportedRoads roads = read_roads(network, map_);
        const RightOfWay patch = right_of_way(find_signs(roads), roads.town);
        if (patch.junctions == 0)
            return;
        write_text(work_ / "signs.nod.xml", patch.nodes);
        write_text(work_ / "signs.edg.xml", patch.edges);
        write_text(work_ / "first.net.xml", network);
        std::vector<std::string> words{"--sumo-net-file",
                                       "first.net.xml",
                                       "--node-files",
                                       "signs.nod.xml",
                                       "--offset.disable-normalization"};
        if (!patch.edges.empty())
            words.insert(words.end(), {"--edge-files", "signs.edg.xml"});
        if (source_.kind != MapKind::network)
            words.emplace_back("--output.original-names");
        convert(words);
        network = stop_only_at(patch.edges_with_stops, network);
        const ImportedRoads now = read_roads(network, map_);
        const ObeyedSigns bind = obeyed_signs(find_signs(now), now.town);
        say("right of way: as stop and yield signs say at {}; of roads with such a sign {} of {} "
            "give way",
            count(patch.junctions, "junction"),
            bind.giving_way,
            bind.roads);
    }

    void from_openstreetmap(const TownImport& wish) {
        fs::create_symlink(fs::absolute(source_.file), work_ / "map.osm");
        check_openstreetmap(source_.file, map_);
        say("OpenStreetMap, traffic drives on the {}", wish.left_hand ? "left" : "right");
        std::vector<std::string> words = openstreetmap_words("map.osm", wish.left_hand);
        if (wish.guess_sidewalks)
            guess_sidewalks(words);
        // Each road says which ways it was made of: bridges and signs are looked up by that.
        words.emplace_back("--output.original-names");
        words.insert(words.end(), {"--junctions.join-output", joins});
        convert(words);
        if (read_roads(network, map_).town.lanes.empty())
            return;  // a clearer word is said when the network is read
        join_overreaching(words);
        const MapShapes shapes = read_shapes("map.osm", made, work_, map_);
        take_back_crossings(words, shapes.crossings);
        // Before signs are obeyed: netconvert would forget which roads have none.
        drop_stubs();
        obey_signs([&](const ImportedRoads& seen) { return lane_signs(shapes.signs, seen.town); });
        shorten_signal_cycles();
        const ImportedRoads roads = read_roads(network, map_);
        Place found;
        const FootprintReport areas = place_footprints(shapes.areas, roads.town, found);
        say("buildings: {} with their own footprints; {} cut back to the edge of a road, {} left "
            "out "
            "that stand on one",
            areas.buildings,
            areas.cut,
            areas.on_roads);
        say("parks, waters, woods and the like: {}", areas.plots);
        if (areas.filled > 0)
            say("courtyards: {} were built over; outlines of buildings have no holes here",
                areas.filled);
        if (areas.broken > 0)
            say("lost: areas whose outline crosses itself: {}", areas.broken);
        if (shapes.open_areas > 0)
            say("lost: areas, or parts of them, whose outline does not close in the map: {}",
                shapes.open_areas);
        count_crossings(shapes.crossings);
        place = place_xml(found);
        if (std::any_of(roads.town.lanes.begin(), roads.town.lanes.end(), [](const auto& lane) {
                return lane.kind == LaneKind::driving;
            }))
            raise(shapes.ways, "in the map");
    }

    /// netconvert's own heights (--osm.layer-elevation) reach as far as the next junction at most,
    /// and leave everything beyond a bridge up.
    void raise(const std::vector<MapShape>& ways, std::string_view known) {
        if (ways.empty())
            return;
        HeightFaultFinder judge({source_.name, network, "", place});
        const RaisedRoads raised =
            raise_roads(network, ways, [&](const std::string& xml) { return judge.faults(xml); });
        say("bridges and tunnels: {} {}; {} where a road passes over another; "
            "{:.2f} km of road raised or lowered for it, the steepest {:.0f} %",
            count(ways.size(), "way"),
            known,
            count(raised.crossings, "place"),
            raised.length / 1000,
            100 * raised.steepest);
        if (raised.steep > 0)
            say("steep: ramps of more than 12 %, as there is no room for longer ones: {} for cars",
                count(raised.steep, "road"));
        for (const auto& [kind, number] : raised.flat)
            say("flat: at the height of what they cross stay {}, because {}",
                count(number, "bridge or tunnel", "bridges and tunnels"),
                kind == HeightFault::Kind::steep ? "ramps would be steeper than 15 %"
                : kind == HeightFault::Kind::low ? "they leave too little room over another road"
                                                 : "the ground would fail a criterion");
    }

    void from_network(const TownImport& wish) {
        const Network loaded = load_network(wish.map);
        say("a SUMO network");
        report += loaded.notes;
        network = without_comments(loaded.xml);
        place = loaded.place;
        if (wish.guess_sidewalks)
            convert_with_sidewalks();
        guess_heights();
    }

    /// A network that was made without heights has lost which road passes over which.
    void guess_heights() {
        const GuessedBridges guessed = guess_bridges(network);
        if (guessed.ways.empty())
            return;
        const std::string flat = std::exchange(network, guessed.network);
        raise(guessed.ways, "guessed, as the network has no heights");
        if (network == guessed.network)
            network = flat;
        else if (flat.find("\"origId\"") == std::string::npos)
            network = without_origins(network);
    }

    void convert_with_sidewalks() {
        write_text(work_ / "map.net.xml", network);
        std::vector<std::string> words{
            "--sumo-net-file", "map.net.xml", "--offset.disable-normalization"};
        words.insert(words.end(), {"--crossings.guess", "--walkingareas"});
        guess_sidewalks(words);
        const std::vector<Eigen::Vector3d> crossings =
            places_of_crossings(read_roads(network, map_).town);
        convert(words);
        take_back_crossings(words, crossings);
    }

    fs::path work_;
    std::string map_;  ///< as the user calls it
    MapSource source_;
};

}  // namespace

std::string import_town(const TownImport& wish, const fs::path& folder) {
    const fs::path work = folder / "import.work";
    fs::create_directory(work);
    const Import import(wish, fs::absolute(work));
    const std::string name = wish.name.empty() ? import.map_name() : wish.name;
    const fs::path network = folder / (name + ".net.xml");
    write_text(network, import.network);
    if (!import.place.empty())
        write_text(folder / (name + ".place.xml"), import.place);
    const std::string report = fmt::format("{}: made of {}\n", name, wish.map.filename().string()) +
                               import.report + check_import(network, work, wish.map.string());
    write_text(folder / "import.txt", report);
    fs::remove_all(work);
    return report;
}

}  // namespace reprise::towns
