#include "cli/town/town_check.h"

#include <algorithm>
#include <chrono>
#include <sys/resource.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "cli/process/temporary_folder.h"
#include "cli/town/towns.h"
#include "cli/town/trial_drives.h"
#include "ground/mesh/build_ground.h"
#include "ground/paint/markings.h"
#include "process/held_signals.h"
#include "towns/check/ends_check.h"
#include "towns/check/furniture_check.h"
#include "towns/check/ground_check.h"
#include "towns/check/lane_check.h"
#include "towns/check/standing_check.h"
#include "towns/check/walk_check.h"
#include "towns/import/import_check.h"
#include "walkers/map/walk_map.h"
#include "world/lanes/density.h"
#include "world/story/wording.h"
#include "world/town.h"

namespace reprise::cli {

namespace {

using towns::Criterion;

/// All that a town is made into, and how long each part took. [s]
struct Built {
    world::TownT town;
    ground::GroundMesh ground;
    ground::GroundMesh markings;
    walkers::WalkMap walk_map;
    std::vector<std::pair<std::string, double>> seconds;
};

class Stopwatch {
  public:
    /// Since the last call. [s]
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// SUMO itself has the last word on a network: a run would end over what it minds.
towns::Network load_for_sumo(const std::string& name) {
    towns::Network network = load_town(name);
    const process::HeldSignals held;
    const TemporaryFolder scratch;
    towns::require_sumo_takes(network.xml, scratch.path(), name);
    return network;
}

Built build(const towns::Network& network) {
    Stopwatch watch;
    world::TownT town = towns::read_town(network);
    const double reading = watch.lap();
    ground::GroundMesh ground = ground::build_ground(town);
    const double meshing = watch.lap();
    ground::GroundMesh markings = ground::build_markings(town);
    const double marking = watch.lap();
    walkers::WalkMap walk_map(ground);
    return {
        std::move(town),
        std::move(ground),
        std::move(markings),
        std::move(walk_map),
        {{"read", reading}, {"ground", meshing}, {"markings", marking}, {"walk map", watch.lap()}}};
}

world::Digest128 digest_of(const world::TownT& town) {
    flatbuffers::FlatBufferBuilder bytes;
    bytes.Finish(world::Town::Pack(bytes, &town));
    return world::digest128(
        {reinterpret_cast<const char*>(bytes.GetBufferPointer()), bytes.GetSize()});
}

/// Made twice from the file: equal to the last bit?
Criterion check_repeats(const Built& first, const Built& second) {
    std::vector<Criterion::Place> faults;
    const auto compare = [&](const char* what, const auto& one, const auto& other) {
        if (!(one == other))
            faults.push_back({what, Eigen::Vector2d::Zero(), 1});
    };
    compare("town", digest_of(first.town), digest_of(second.town));
    compare("ground", towns::digest_of(first.ground), towns::digest_of(second.ground));
    compare("markings", towns::digest_of(first.markings), towns::digest_of(second.markings));
    compare("walk map", first.walk_map.digest(), second.walk_map.digest());
    return towns::none_of(
        "differences when read twice", std::move(faults), "town, ground, markings, walk map");
}

std::vector<Criterion> check(const Built& first, const Built& second) {
    std::vector<Criterion> criteria = towns::check_ground(first.town, first.ground);
    criteria.push_back(towns::check_ends(first.town, first.ground));
    for (Criterion& criterion : towns::check_lanes(first.town))
        criteria.push_back(std::move(criterion));
    criteria.push_back(towns::check_walking(first.town, first.walk_map));
    for (Criterion& criterion : towns::check_furniture(first.town))
        criteria.push_back(std::move(criterion));
    for (Criterion& criterion : towns::check_standing(first.town, first.ground))
        criteria.push_back(std::move(criterion));
    criteria.push_back(check_repeats(first, second));
    return criteria;
}

/// Length of the lanes that cars may use between junctions. [km]
double drivable_km(const world::TownT& town) {
    double metres = 0;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving)
            metres += lane.length;
    return metres / 1000;
}

/// Of this process, so far. [MB]
long peak_memory_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

std::string with_unit(double figure, const std::string& unit) {
    return unit.empty() ? fmt::format("{:.0f}", figure) : fmt::format("{:.3f} {}", figure, unit);
}

void print_criterion(const Criterion& criterion) {
    say("  {:<5}{:<28}{:>10}   {} {:<10} {}\n",
        criterion.passed() ? "ok" : "FAIL",
        criterion.name,
        with_unit(criterion.figure, criterion.unit),
        criterion.at_least ? ">=" : "<=",
        with_unit(criterion.limit, criterion.unit),
        criterion.looked_at);
    for (std::size_t i = 0; i < std::min(criterion.worst.size(), towns::shown_places); ++i) {
        const Criterion::Place& place = criterion.worst[i];
        say("         {} at ({:.2f}, {:.2f}){}\n",
            place.name,
            place.position.x(),
            place.position.y(),
            criterion.unit.empty() ? "" : ": " + with_unit(place.value, criterion.unit));
    }
}

void print_table(const Built& built, const std::vector<Criterion>& criteria) {
    say("{}: {}, {:.2f} km of driving lanes, {}, {}\n",
        built.town.name,
        world::count_of(built.town.lanes.size(), "lane"),
        drivable_km(built.town),
        world::count_of(built.town.junctions.size(), "junction"),
        world::count_of(built.town.signals.size(), "signal"));
    for (const Criterion& criterion : criteria)
        print_criterion(criterion);
    say("  {} of ground, {} of markings; walk map: {}, {} kB\n",
        world::count_of(built.ground.triangles.size(), "triangle"),
        built.markings.triangles.size(),
        world::count_of(built.walk_map.polygons(), "polygon"),
        built.walk_map.bytes() / 1024);
    std::string times;
    for (const auto& [part, seconds] : built.seconds)
        times += fmt::format("{}{} {:.2f} s", times.empty() ? "" : ", ", part, seconds);
    say("  {}; {} MB at most\n", times, peak_memory_mb());
}

nlohmann::json to_json(const Criterion& criterion) {
    nlohmann::json worst = nlohmann::json::array();
    for (const Criterion::Place& place : criterion.worst)
        worst.push_back({{"name", place.name},
                         {"x", place.position.x()},
                         {"y", place.position.y()},
                         {"value", place.value}});
    return {{"name", criterion.name},
            {"figure", criterion.figure},
            {"limit", criterion.limit},
            {"at_least", criterion.at_least},
            {"unit", criterion.unit},
            {"passed", criterion.passed()},
            {"looked_at", criterion.looked_at},
            {"worst", worst}};
}

void print_json(const Built& built, const std::vector<Criterion>& criteria, bool passed) {
    nlohmann::json report = {{"town", built.town.name},
                             {"passed", passed},
                             {"lanes", built.town.lanes.size()},
                             {"drivable_km", drivable_km(built.town)},
                             {"junctions", built.town.junctions.size()},
                             {"signals", built.town.signals.size()},
                             {"ground_triangles", built.ground.triangles.size()},
                             {"marking_triangles", built.markings.triangles.size()},
                             {"walk_polygons", built.walk_map.polygons()},
                             {"walk_bytes", built.walk_map.bytes()},
                             {"peak_memory_mb", peak_memory_mb()},
                             {"criteria", nlohmann::json::array()}};
    for (const Criterion& criterion : criteria)
        report["criteria"].push_back(to_json(criterion));
    for (const auto& [part, seconds] : built.seconds)
        report["seconds"][part] = seconds;
    say_lines(report.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace

int town_check(const TownCheckOptions& options) {
    const towns::Network network = load_for_sumo(options.town);
    const Built first = build(network);
    std::vector<Criterion> criteria = check(first, build(load_town(options.town)));
    criteria.push_back(check_driving(network, world::cars_carried(first.town)));
    const auto failed =
        std::count_if(criteria.begin(), criteria.end(), [](const Criterion& criterion) {
            return !criterion.passed();
        });
    if (options.json) {
        print_json(first, criteria, failed == 0);
    } else {
        print_table(first, criteria);
        say("{}\n",
            failed == 0 ? fmt::format("all {} criteria hold", criteria.size())
                        : fmt::format("{} of {} criteria do not hold", failed, criteria.size()));
    }
    return failed == 0 ? exit_good : exit_differs;
}

}  // namespace reprise::cli
