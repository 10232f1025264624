// What it must do: make points of a network's roads, close enough to shape ramps with.
// What it assumes: netconvert's names: "-X" is the way back of "X"; ":J_0" lies in junction J.
// How it goes: one point for each junction; edges become chains of points between two of them, an
//   edge and its way back the same one; steps are shorter than they are near junctions.
// What it keeps: the order of the file.
#include "towns/bridges/road_chains.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/geometry2d.h"
#include "world/town.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::Loop;

constexpr double point_spacing = 5;    ///< [m] of points along a chain
constexpr double taper = 10;           ///< [m] from a junction, within which a ramp gets its slope
constexpr double shortest_paths = 3;   ///< [m] a mere joint of two roads has no longer ones
constexpr double least_share = 0.05;   ///< of a step: also where it should be level
constexpr double default_width = 3.2;  ///< [m] SUMO's

/// The lanes of one edge.
struct Lanes {
    Loop innermost;
    Loop middle;
    double width = 0;
};

Lanes lanes_of(const pugi::xml_node& edge) {
    Lanes lanes;
    std::vector<Loop> lines;
    for (const pugi::xml_node lane : edge.children("lane")) {
        lines.push_back(world::in_plan(parse_shape(lane.attribute("shape").value())));
        lanes.width += number(lane.attribute("width").value(), default_width);
    }
    if (lines.empty())
        return lanes;
    lanes.innermost = lines.back();
    lanes.middle = lines[lines.size() / 2];
    if (lines.front().size() == lines.back().size())
        for (std::size_t i = 0; i < lines.front().size() && i < lanes.middle.size(); ++i)
            lanes.middle[i] = (lines.front()[i] + lines.back()[i]) / 2;
    return lanes;
}

std::vector<std::string> ways_of(const pugi::xml_node& edge) {
    std::vector<std::string> ways;
    const pugi::xml_node param =
        edge.child("lane").find_child_by_attribute("param", "key", "origId");
    for (const std::string_view way : world::words(param.attribute("value").value()))
        ways.emplace_back(way);
    return ways;
}

class ChainReader {
  public:
    explicit ChainReader(const pugi::xml_node& net) : net_(net) {}

    RoadChains read();

  private:
    void read_junctions();
    void read_paths();
    void read_edges();
    void add_chain(const pugi::xml_node& edge, const Loop& line);
    void connect(const Chain& chain, double length);
    std::uint32_t add_point(const Vector2d& place);
    bool is_joint(std::uint32_t junction) const;

    const pugi::xml_node& net_;
    RoadChains roads_;
    std::vector<std::set<std::string>> ways_at_;  ///< each junction, by its point
    std::vector<double> longest_path_;            ///< [m] of each junction, by its point
    std::vector<int> roads_at_;                   ///< likewise: how many end there
    std::vector<double> chain_lengths_;
};

std::uint32_t ChainReader::add_point(const Vector2d& place) {
    roads_.places.push_back(place);
    roads_.steps.emplace_back();
    return static_cast<std::uint32_t>(roads_.places.size() - 1);
}

void ChainReader::read_junctions() {
    for (const pugi::xml_node junction : net_.children("junction"))
        if (std::string_view(junction.attribute("type").value()) != "internal")
            roads_.junctions[junction.attribute("id").value()] =
                add_point({number(junction.attribute("x").value(), 0),
                           number(junction.attribute("y").value(), 0)});
    longest_path_.resize(roads_.places.size(), 0);
    roads_at_.resize(roads_.places.size(), 0);
    ways_at_.resize(roads_.places.size());
}

void ChainReader::read_paths() {
    for (const pugi::xml_node edge : net_.children("edge")) {
        if (std::string_view(edge.attribute("function").value()) != "internal")
            continue;
        const auto junction = roads_.junctions.find(junction_around(edge.attribute("id").value()));
        if (junction == roads_.junctions.end())
            continue;
        for (const pugi::xml_node lane : edge.children("lane")) {
            const Loop line = world::in_plan(parse_shape(lane.attribute("shape").value()));
            if (line.size() < 2)
                continue;
            double& longest = longest_path_[junction->second];
            longest = std::max(longest, plan_length(line));
            const std::set<std::string>& ways = ways_at_[junction->second];
            roads_.tracks.push_back({line,
                                     default_width / 2,
                                     {junction->second},
                                     std::vector<std::string>(ways.begin(), ways.end()),
                                     world::none});
        }
    }
}

void ChainReader::add_chain(const pugi::xml_node& edge, const Loop& line) {
    const double length = plan_length(line);
    const int count = std::max(1, static_cast<int>(std::ceil(length / point_spacing)));
    Chain chain;
    for (int i = 0; i <= count; ++i)
        chain.places.push_back(point_along(line, static_cast<double>(i) / count).place);
    chain.points.push_back(roads_.junctions.at(edge.attribute("from").value()));
    for (int i = 1; i < count; ++i)
        chain.points.push_back(add_point(chain.places[static_cast<std::size_t>(i)]));
    chain.points.push_back(roads_.junctions.at(edge.attribute("to").value()));
    ++roads_at_[chain.points.front()];
    ++roads_at_[chain.points.back()];
    roads_.chains.push_back(std::move(chain));
    chain_lengths_.push_back(length);
}

void ChainReader::read_edges() {
    for (const pugi::xml_node edge : net_.children("edge")) {
        const std::string id = edge.attribute("id").value();
        const Lanes lanes = lanes_of(edge);
        if (edge.attribute("function") || lanes.innermost.size() < 2 ||
            !roads_.junctions.contains(edge.attribute("from").value()) ||
            !roads_.junctions.contains(edge.attribute("to").value()))
            continue;
        const auto back = roads_.edges.find(id.starts_with('-') ? id.substr(1) : "-" + id);
        const auto joins = [&](const Chain& chain) {
            return chain.points.front() == roads_.junctions[edge.attribute("to").value()] &&
                   chain.points.back() == roads_.junctions[edge.attribute("from").value()];
        };
        if (back != roads_.edges.end() && joins(roads_.chains[back->second.chain])) {
            roads_.edges[id] = {back->second.chain, true};
        } else {
            roads_.edges[id] = {static_cast<std::uint32_t>(roads_.chains.size()), false};
            add_chain(edge, lanes.innermost);
        }
        std::vector<std::uint32_t> points = roads_.chains[roads_.edges[id].chain].points;
        if (roads_.edges[id].reversed)
            std::reverse(points.begin(), points.end());
        std::vector<std::string> ways = ways_of(edge);
        for (const std::uint32_t junction : {points.front(), points.back()})
            ways_at_[junction].insert(ways.begin(), ways.end());
        roads_.tracks.push_back({lanes.middle,
                                 lanes.width / 2,
                                 std::move(points),
                                 std::move(ways),
                                 roads_.edges[id].chain});
    }
}

/// Two roads meet there and nothing else happens, or one ends: no place that must be level.
bool ChainReader::is_joint(std::uint32_t junction) const {
    return roads_at_[junction] <= 2 && longest_path_[junction] <= shortest_paths;
}

/// In a bend the inner lanes are shorter, and so steeper, than the outer ones.
double bend_share(const Chain& chain, std::size_t step) {
    constexpr double tightest = 8;  // [m] of radius: a corner, which must be level
    const std::size_t first = step > 0 ? step - 1 : step;
    const std::size_t last = std::min(step + 2, chain.places.size() - 1);
    double turn = 0;
    double length = 0;
    for (std::size_t i = first; i < last; ++i) {
        const Vector2d along = chain.places[i + 1] - chain.places[i];
        length += along.norm();
        if (i == first)
            continue;
        const Vector2d before = chain.places[i] - chain.places[i - 1];
        turn += std::abs(std::atan2(world::cross(before, along), before.dot(along)));
    }
    return length > 0 ? 1 - tightest * turn / length : 0;
}

void ChainReader::connect(const Chain& chain, double length) {
    const double step = length / static_cast<double>(chain.points.size() - 1);
    const bool level_start = !is_joint(chain.points.front());
    const bool level_end = !is_joint(chain.points.back());
    for (std::size_t i = 0; i + 1 < chain.points.size(); ++i) {
        const double middle = (static_cast<double>(i) + 0.5) * step;
        double share = 1;
        if (level_start)
            share = std::min(share, middle / taper);
        if (level_end)
            share = std::min(share, (length - middle) / taper);
        const double felt = step * std::max(std::min(share, bend_share(chain, i)), least_share);
        roads_.steps[chain.points[i]].push_back({chain.points[i + 1], felt});
        roads_.steps[chain.points[i + 1]].push_back({chain.points[i], felt});
    }
}

RoadChains ChainReader::read() {
    read_junctions();
    read_edges();
    read_paths();
    for (std::size_t i = 0; i < roads_.chains.size(); ++i)
        connect(roads_.chains[i], chain_lengths_[i]);
    return std::move(roads_);
}

}  // namespace

RoadChains read_road_chains(const pugi::xml_node& net) {
    return ChainReader(net).read();
}

void keep_together(RoadChains& roads, const std::vector<std::uint32_t>& points) {
    constexpr double near = 0.1;  // [m]
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        roads.steps[points[i]].push_back({points[i + 1], near});
        roads.steps[points[i + 1]].push_back({points[i], near});
    }
}

std::vector<double> distances(const RoadChains& roads,
                              const std::vector<Source>& sources,
                              double farthest) {
    std::vector<double> found(roads.places.size(), farthest);
    std::set<std::pair<double, std::uint32_t>> open;
    for (const Source& source : sources) {
        found[source.point] = std::min(found[source.point], source.head_start);
        open.emplace(source.head_start, source.point);
    }
    while (!open.empty()) {
        const auto [distance, point] = *open.begin();
        open.erase(open.begin());
        if (distance > found[point])
            continue;
        for (const RoadChains::Step& step : roads.steps[point]) {
            const double through = distance + step.length;
            if (through >= found[step.to])
                continue;
            found[step.to] = through;
            open.emplace(through, step.to);
        }
    }
    return found;
}

double plan_length(const Loop& line) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        length += (line[i + 1] - line[i]).norm();
    return length;
}

LinePoint point_along(const Loop& line, double share) {
    double rest = share * plan_length(line);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vector2d along = line[i + 1] - line[i];
        const double length = along.norm();
        if (length > 0 && (length >= rest || i + 2 == line.size()))
            return {line[i] + along * (rest / length), along / length};
        rest -= length;
    }
    return {line.back(), Vector2d::UnitX()};
}

}  // namespace reprise::towns
