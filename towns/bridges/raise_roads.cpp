// What it must do: lift bridges clear of what they cross, without a step and without a ramp that no
//   car can climb; leave alone what has nothing to do with them.
// What it assumes: all heights are 0.
// How it goes: the roads as points (road_chains); levels of those that must be up or down (levels);
//   heights of all (road_heights); then these are written into every shape (height_profile). Where
//   the town that comes out of it is worse than the flat one, the span that causes it stays flat,
//   and all begins anew.
// What it keeps: places in plan, lengths, and the order of the file.
#include "towns/bridges/raise_roads.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/bridges/height_profile.h"
#include "towns/bridges/levels.h"
#include "towns/bridges/responsible_span.h"
#include "towns/bridges/road_chains.h"
#include "towns/bridges/road_heights.h"
#include "towns/network/network_xml.h"
#include "world/check.h"
#include "world/models/vehicle_classes.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::Loop;

constexpr double steep_slope = 0.12;     ///< is worth a word
constexpr double least_height = 0.0005;  ///< [m] less is 0

Loop plan_of(const pugi::xml_attribute& shape) {
    return world::in_plan(parse_shape(shape.value()));
}

std::vector<Eigen::Vector3d> at_height(const Loop& line, double z) {
    std::vector<Eigen::Vector3d> lifted;
    for (const Vector2d& p : line)
        lifted.emplace_back(p.x(), p.y(), z);
    return lifted;
}

/// Writes one height into a shape.
void set_level(pugi::xml_attribute shape, double z) {
    if (shape.empty())
        return;
    shape.set_value(shape_text(at_height(plan_of(shape), z)).c_str());
}

/// Writes heights into the elements of one network.
class Writer {
  public:
    Writer(pugi::xml_node net, const RoadChains& roads, const std::vector<double>& heights)
        : net_(net),
          roads_(roads),
          heights_(heights) {}

    void write(RaisedRoads& report);

  private:
    double height_of(const std::string& junction) const;
    void write_junctions();
    void write_inside(pugi::xml_node edge, double z);
    void write_road(pugi::xml_node edge, const HeightProfile& profile, RaisedRoads& report);
    pugi::xml_attribute reference_line(pugi::xml_node edge) const;

    pugi::xml_node net_;
    const RoadChains& roads_;
    const std::vector<double>& heights_;
};

double Writer::height_of(const std::string& junction) const {
    const auto found = roads_.junctions.find(junction);
    return found == roads_.junctions.end() ? 0 : heights_[found->second];
}

void Writer::write_junctions() {
    for (pugi::xml_node junction : net_.children("junction")) {
        const std::string id = junction.attribute("id").value();
        const double z =
            height_of(id.starts_with(':') ? junction_around(junction_around(id) + "_") : id);
        if (std::abs(z) < least_height)
            continue;
        if (!junction.attribute("z"))
            junction.insert_attribute_after("z", junction.attribute("y"));
        junction.attribute("z").set_value(fmt::format("{:.3f}", z).c_str());
        set_level(junction.attribute("shape"), z);
    }
}

void Writer::write_inside(pugi::xml_node edge, double z) {
    if (std::abs(z) < least_height)
        return;
    for (pugi::xml_node lane : edge.children("lane")) {
        set_level(lane.attribute("shape"), z);
        set_level(lane.attribute("outlineShape"), z);
    }
}

/// The line from which netconvert makes the lanes again; left out where it is straight from one
/// junction to the other.
pugi::xml_attribute Writer::reference_line(pugi::xml_node edge) const {
    if (pugi::xml_attribute shape = edge.attribute("shape"))
        return shape;
    pugi::xml_attribute shape = edge.append_attribute("shape");
    const Vector2d& from = roads_.places[roads_.junctions.at(edge.attribute("from").value())];
    const Vector2d& to = roads_.places[roads_.junctions.at(edge.attribute("to").value())];
    shape.set_value(shape_text(at_height({from, to}, 0)).c_str());
    return shape;
}

void Writer::write_road(pugi::xml_node edge, const HeightProfile& profile, RaisedRoads& report) {
    if (profile.is_flat())
        return;
    pugi::xml_attribute reference = reference_line(edge);
    reference.set_value(shape_text(profile.lift(plan_of(reference))).c_str());
    bool is_steep = false;
    for (pugi::xml_node lane : edge.children("lane")) {
        const auto line = profile.lift(plan_of(lane.attribute("shape")));
        lane.attribute("shape").set_value(shape_text(line).c_str());
        const world::ClassSet classes =
            world::permitted(lane.attribute("allow").value(), lane.attribute("disallow").value());
        if ((classes & world::class_bit("passenger")) == 0)
            continue;
        const double slope = steepest(line);
        report.steepest = std::max(report.steepest, slope);
        is_steep = is_steep || slope > steep_slope;
    }
    report.steep += is_steep ? 1 : 0;
    report.length += plan_length(plan_of(reference));
}

void Writer::write(RaisedRoads& report) {
    write_junctions();
    for (pugi::xml_node edge : net_.children("edge")) {
        const std::string id = edge.attribute("id").value();
        const auto road = roads_.edges.find(id);
        if (road != roads_.edges.end())
            write_road(edge, HeightProfile(roads_, heights_, road->second), report);
        else if (id.starts_with(':'))
            write_inside(edge, height_of(junction_around(id)));
    }
}

/// All of a network, raised.
struct Raised {
    std::string network;
    RoadChains roads;
    Levels levels;
    std::vector<double> heights;
    RaisedRoads report;
};

Raised raise_once(const std::string& network,
                  const std::vector<MapShape>& ways,
                  const std::set<std::uint32_t>& flat) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(network.data(), network.size(), pugi::parse_full);
    REPRISE_CHECK(parsed, "the network that netconvert made is XML");
    pugi::xml_node net = document.child("net");
    Raised raised;
    raised.roads = read_road_chains(net);
    raised.levels = find_levels(raised.roads, ways, flat);
    raised.report.crossings = raised.levels.crossings;
    if (raised.levels.crossings == 0)
        return raised;
    for (const auto* groups : {&raised.levels.crossed, &raised.levels.touching})
        for (const std::vector<std::uint32_t>& points : *groups)
            keep_together(raised.roads, points);
    raised.heights = find_heights(raised.roads, raised.levels);
    Writer(net, raised.roads, raised.heights).write(raised.report);
    std::ostringstream text;
    document.save(text, "    ");
    raised.network = std::move(text).str();
    return raised;
}

struct Flattened {
    std::uint32_t span = 0;
    HeightFault::Kind reason;
};

/// Few at a time, those with the most faults first: with one bridge flat, its neighbours may do.
/// Those that are far from each other have nothing to do with each other, so that a large network
/// needs no more rounds than a small one.
std::vector<Flattened> to_flatten(const Raised& raised, const std::vector<HeightFault>& faults) {
    constexpr std::size_t parts = 8;
    constexpr double far_apart = 400;  // [m] more than two ramps
    const ResponsibleSpan responsible_span(raised.roads, raised.levels, raised.heights);
    std::map<std::uint32_t, std::vector<HeightFault>> faults_of;
    for (const HeightFault& fault : faults)
        faults_of[responsible_span.at(fault.place)].push_back(fault);
    std::vector<std::uint32_t> order;
    for (const auto& [span, its_faults] : faults_of)
        order.push_back(span);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t one, std::uint32_t other) {
        return faults_of[one].size() > faults_of[other].size();
    });
    std::vector<Flattened> worst;
    std::vector<Vector2d> places;  // of those
    for (std::size_t i = 0; i < order.size(); ++i) {
        const HeightFault& first = faults_of[order[i]].front();
        const bool is_alone = std::none_of(places.begin(), places.end(), [&](const Vector2d& p) {
            return (p - first.place).norm() < far_apart;
        });
        if (i * parts >= order.size() && !is_alone)
            continue;
        worst.push_back({order[i], first.kind});
        places.push_back(first.place);
    }
    return worst;
}

}  // namespace

RaisedRoads raise_roads(std::string& network,
                        const std::vector<MapShape>& ways,
                        const FindFaults& find_faults) {
    std::set<std::uint32_t> flat;
    std::map<HeightFault::Kind, int> reasons;
    RaisedRoads report;
    while (!ways.empty()) {
        const Raised raised = raise_once(network, ways, flat);
        report = raised.report;
        report.flat = reasons;
        if (report.crossings == 0)
            break;
        const std::vector<HeightFault> faults = find_faults(raised.network);
        if (faults.empty()) {
            network = raised.network;
            break;
        }
        for (const auto& [span, reason] : to_flatten(raised, faults)) {
            const bool is_new = flat.insert(span).second;
            REPRISE_CHECK(is_new, "a bridge that is flat already spoils nothing");
            ++reasons[reason];
        }
    }
    return report;
}

}  // namespace reprise::towns
