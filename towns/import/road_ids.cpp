// What it must do: tell every lane which parts of which OpenDRIVE roads it is.
// What it assumes: netconvert lists roads and lanes in the order in which one drives through them.
// How it goes: points of a road's reference line, a metre apart, are dropped onto the lane; each is
// a
//   knot, our s beside the road's. Knots that lie between their neighbours are left out.
// What it keeps: nothing.
#include "towns/import/road_ids.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include "world/check.h"
#include "world/lanes/road_place.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using Knot = world::RoadPiece::Knot;

constexpr double sample = 1;          // [m] between points of a reference line
constexpr double farthest_lane = 40;  // [m] from a road's reference line to one of its lanes
constexpr double tolerance = 0.05;    // [m] of a knot that is left out

/// A lane in plan, with the s that the town gives its points.
class PlanLine {
  public:
    explicit PlanLine(const world::LaneT& lane) {
        double s = 0;
        for (std::size_t i = 0; i < lane.centre.size(); ++i) {
            const world::Vec3& point = lane.centre[i];
            if (i > 0) {
                const world::Vec3& last = lane.centre[i - 1];
                s += std::hypot(point.x() - last.x(), point.y() - last.y(), point.z() - last.z());
            }
            points_.emplace_back(point.x(), point.y());
            s_.push_back(s);
        }
    }

    struct Foot {
        double s = 0;
        double distance = 0;
        double heading = 0;
        bool inside = false;  ///< the point lies beside the line, not before or behind it
    };

    Foot foot_of(const Vector2d& p) const {
        Foot best;
        best.distance = INFINITY;
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const Vector2d along = points_[i + 1] - points_[i];
            const double length = along.squaredNorm();
            if (length == 0)
                continue;
            const double share = along.dot(p - points_[i]) / length;
            const double held = std::clamp(share, 0.0, 1.0);
            const double distance = (points_[i] + held * along - p).norm();
            if (distance >= best.distance)
                continue;
            constexpr double slack = 1e-3;
            const bool before = i == 0 && share < -slack;
            const bool behind = i + 2 == points_.size() && share > 1 + slack;
            best = {s_[i] + held * (s_[i + 1] - s_[i]),
                    distance,
                    std::atan2(along.y(), along.x()),
                    !before && !behind};
        }
        return best;
    }

    const Vector2d& front() const { return points_.front(); }

    const Vector2d& back() const { return points_.back(); }

    double length() const { return s_.back(); }

  private:
    std::vector<Vector2d> points_;
    std::vector<double> s_;
};

/// The s of the reference line at which p lies beside it.
double s_beside(const MapRoad& road, const Vector2d& p) {
    const auto distance = [&](double s) { return (road.line.at(s).position - p).squaredNorm(); };
    double best = 0;
    for (double s = 0; s <= road.length; s += sample)
        best = distance(s) < distance(best) ? s : best;
    double low = std::max(best - sample, 0.0), high = std::min(best + sample, road.length);
    for (int i = 0; i < 40; ++i) {
        const double third = (high - low) / 3;
        (distance(low + third) < distance(high - third) ? high : low) =
            distance(low + third) < distance(high - third) ? high - third : low + third;
    }
    return (low + high) / 2;
}

/// Without those that lie between their neighbours (Douglas and Peucker).
void thin_out(const std::vector<Knot>& all,
              std::size_t from,
              std::size_t to,
              std::vector<Knot>& kept) {
    std::size_t worst = from;
    double most = tolerance;
    for (std::size_t i = from + 1; i < to; ++i) {
        const double share = (all[i].s - all[from].s) / (all[to].s - all[from].s);
        const double off = std::abs(all[from].road_s + share * (all[to].road_s - all[from].road_s) -
                                    all[i].road_s);
        if (off > most)
            std::tie(worst, most) = std::pair(i, off);
    }
    if (worst != from) {
        thin_out(all, from, worst, kept);
        thin_out(all, worst, to, kept);
    } else {
        kept.push_back(all[to]);
    }
}

/// All places that one s cannot have on a line are left out: knots grow in s, and run one way along
/// the road.
std::vector<Knot> in_order(std::vector<Knot> knots) {
    std::sort(knots.begin(), knots.end(), [](const Knot& a, const Knot& b) { return a.s < b.s; });
    std::vector<Knot> ordered;
    if (knots.empty())
        return ordered;
    const bool grows = knots.back().road_s >= knots.front().road_s;
    for (const Knot& knot : knots)
        if (ordered.empty() ||
            (knot.s > ordered.back().s + 1e-6 && (knot.road_s >= ordered.back().road_s) == grows))
            ordered.push_back(knot);
    return ordered;
}

/// What the lane has of this road; `first`, `last`: it begins, ends in it.
std::vector<Knot> knots_on(
    const PlanLine& lane, const MapRoad& road, const Vector2d& offset, bool first, bool last) {
    std::vector<Knot> knots;
    const Knot start{0, s_beside(road, lane.front() - offset)};
    const Knot end{lane.length(), s_beside(road, lane.back() - offset)};
    const auto add = [&](double s) {
        const RoadPose pose = road.line.at(s);
        const PlanLine::Foot foot = lane.foot_of(pose.position + offset);
        if (!foot.inside || foot.distance > farthest_lane)
            return;
        // A road that comes around lies beside its own far side: that runs another way.
        const bool along = std::cos(foot.heading - pose.heading) > 0.5;
        const bool against = std::cos(foot.heading - pose.heading) < -0.5;
        if (along || against)
            knots.push_back({foot.s, s});
    };
    for (double s = 0; s < road.length; s += sample)
        add(s);
    add(road.length);
    // The ends of the lane itself; what lies before and behind them is not its own.
    if (first && last) {
        const auto [low, high] = std::minmax(start.road_s, end.road_s);
        std::erase_if(knots, [&, low = low, high = high](const Knot& knot) {
            return knot.road_s <= low || knot.road_s >= high;
        });
    }
    if (first)
        knots.push_back(start);
    if (last)
        knots.push_back(end);
    const std::vector<Knot> ordered = in_order(std::move(knots));
    std::vector<Knot> kept;
    if (ordered.size() >= 2) {
        kept.push_back(ordered.front());
        thin_out(ordered, 0, ordered.size() - 1, kept);
    }
    return kept;
}

/// "12_-1": road and lane.
std::optional<std::pair<std::string, int>> parted(const std::string& word) {
    const std::size_t bar = word.rfind('_');
    int lane = 0;
    if (bar == std::string::npos || word.find_first_of(";|:") != std::string::npos)
        return std::nullopt;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + bar + 1, end, lane);
    if (error != std::errc() || stop != end)
        return std::nullopt;
    return std::pair(word.substr(0, bar), lane);
}

std::vector<world::RoadPiece> pieces_of(const world::LaneT& lane,
                                        const std::string& original,
                                        const OpenDrive& map,
                                        const Vector2d& offset) {
    std::vector<std::pair<std::string, int>> roads;
    std::istringstream words(original);
    for (std::string word; words >> word;)
        if (auto road = parted(word); road && map.roads.count(road->first) != 0)
            roads.push_back(std::move(*road));
    const PlanLine line(lane);
    std::vector<world::RoadPiece> pieces;
    for (std::size_t i = 0; i < roads.size(); ++i) {
        const auto& [road, number] = roads[i];
        std::vector<Knot> knots =
            knots_on(line, map.roads.at(road), offset, i == 0, i + 1 == roads.size());
        if (!knots.empty())
            pieces.push_back({road, number, std::move(knots)});
    }
    return pieces;
}

}  // namespace

RoadIds add_road_ids(const std::string& network, const ImportedRoads& roads, const OpenDrive& map) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(network.data(), network.size(), pugi::parse_full);
    REPRISE_CHECK(parsed, "the network that netconvert made is XML");
    const Vector2d offset = offset_of(map, roads);
    RoadIds ids;
    for (const pugi::xml_node edge : document.child("net").children("edge"))
        for (pugi::xml_node lane_xml : edge.children("lane")) {
            pugi::xml_node original = lane_xml.find_child_by_attribute("param", "key", "origId");
            const auto lane = world::find_lane(roads.town, lane_xml.attribute("id").value());
            std::vector<world::RoadPiece> pieces;
            if (original && lane)
                pieces = pieces_of(
                    roads.town.lanes[*lane], original.attribute("value").value(), map, offset);
            if (*edge.attribute("function").value() == '\0')
                ++(pieces.empty() ? ids.unknown : ids.lanes);
            if (pieces.empty()) {
                lane_xml.remove_child(original);
                continue;
            }
            original.attribute("key").set_value("road");
            original.attribute("value").set_value(world::road_pieces_text(pieces).c_str());
        }
    std::ostringstream text;
    document.save(text, "    ");
    ids.network = std::move(text).str();
    return ids;
}

}  // namespace reprise::towns
