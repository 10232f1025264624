#include "towns/network/waiting_places.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/geometry2d.h"
#include "world/units.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double half_car = 0.95;     // [m] of the one who waits
constexpr double half_way = 1.3;      // [m] that one who passes takes up, a bus in a bend left out
constexpr double moved_at_most = 5;   // [m] that a place is moved
constexpr double tried_every = 0.25;  // [m] between the places tried
constexpr double least_length = 5;    // [m] left of the first part: a car stands inside
constexpr double way_out = 6;         // [m] of the lane behind the junction

Points points_of(pugi::xml_node lane) {
    Points points;
    for (const world::Vec3& point : parse_shape(lane.attribute("shape").value()))
        points.emplace_back(point.x(), point.y(), point.z());
    return points;
}

double length_of(const Points& line) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += (line[i] - line[i - 1]).head<2>().norm();
    return length;
}

/// Cut in two at `s` [m] along it, in plan.
std::pair<Points, Points> cut(const Points& line, double s) {
    std::pair<Points, Points> parts;
    double start = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double length = (line[i + 1] - line[i]).head<2>().norm();
        (start <= s ? parts.first : parts.second).push_back(line[i]);
        if (start <= s && s < start + length) {
            const Eigen::Vector3d middle =
                line[i] + (line[i + 1] - line[i]) * ((s - start) / length);
            parts.first.push_back(middle);
            parts.second.push_back(middle);
        }
        start += length;
    }
    parts.second.push_back(line.back());
    return parts;
}

double distance(const Eigen::Vector2d& point, const Points& line) {
    double least = world::infinity;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector2d from = line[i].head<2>();
        const Eigen::Vector2d along = line[i + 1].head<2>() - from;
        const double share =
            std::clamp((point - from).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
        least = std::min(least, (from + share * along - point).norm());
    }
    return least;
}

/// Is a bumper at the end of this line in the way of those who drive along `other`?
bool in_the_way(const Points& line, const Points& other) {
    const Eigen::Vector2d end = line.back().head<2>();
    const Eigen::Vector2d ahead = (end - line[line.size() - 2].head<2>()).normalized();
    const Eigen::Vector2d left = world::turned_left(ahead) * half_car;
    return distance(end, other) < half_way || distance(end + left, other) < half_way ||
           distance(end - left, other) < half_way;
}

bool cross(const Points& one, const Points& other) {
    for (std::size_t i = 0; i + 1 < one.size(); ++i)
        for (std::size_t k = 0; k + 1 < other.size(); ++k) {
            const Eigen::Vector2d a = one[i].head<2>();
            const Eigen::Vector2d b = one[i + 1].head<2>();
            const Eigen::Vector2d c = other[k].head<2>();
            const Eigen::Vector2d d = other[k + 1].head<2>();
            if (world::cross(b - a, c - a) * world::cross(b - a, d - a) < 0 &&
                world::cross(d - c, a - c) * world::cross(d - c, b - c) < 0)
                return true;
        }
    return false;
}

std::string shape_text(const Points& line, bool has_heights) {
    std::string text;
    for (const Eigen::Vector3d& point : line) {
        text += fmt::format("{}{:.3f},{:.3f}", text.empty() ? "" : " ", point.x(), point.y());
        if (has_heights)
            text += fmt::format(",{:.3f}", point.z());
    }
    return text;
}

bool has_heights(pugi::xml_node lane) {
    const std::vector<std::string_view> points = world::words(lane.attribute("shape").value());
    return std::any_of(points.begin(), points.end(), [](std::string_view point) {
        return std::count(point.begin(), point.end(), ',') > 1;
    });
}

/// The paths through junctions of a network.
class Paths {
  public:
    explicit Paths(pugi::xml_node net) {
        for (const pugi::xml_node edge : net.children("edge")) {
            const std::string_view function = edge.attribute("function").value();
            if (function == "crossing" || function == "walkingarea")
                continue;
            for (const pugi::xml_node lane : edge.children("lane")) {
                const std::string id = lane.attribute("id").value();
                lanes_[id] = lane;
                if (function == "internal")
                    inside_[junction_around(edge.attribute("id").value())].push_back(id);
            }
        }
        for (const pugi::xml_node link : net.children("connection")) {
            const auto lane = [&link](const char* edge, const char* index) {
                return fmt::format(
                    "{}_{}", link.attribute(edge).value(), link.attribute(index).value());
            };
            const std::string from = lane("from", "fromLane");
            const std::string via = link.attribute("via").value();
            if (from.starts_with(':')) {
                next_[from] = via.empty() ? lane("to", "toLane") : via;
                waits_.emplace(via, from);
            } else if (!via.empty()) {
                origins_[via] = link.attribute("from").value();
            }
        }
        for (const auto& [second, first] : waits_)
            if (const auto origin = origins_.find(first); origin != origins_.end())
                origins_[second] = origin->second;
    }

    /// Null when there is none.
    pugi::xml_node lane(const std::string& id) const {
        const auto found = lanes_.find(id);
        return found == lanes_.end() ? pugi::xml_node() : found->second;
    }

    /// The path before a second part; "" when it is none.
    std::string first_part(const std::string& second) const {
        const auto found = waits_.find(second);
        return found == waits_.end() ? "" : found->second;
    }

    /// A path from this lane of it on to some metres behind the junction.
    Points from(std::string id) const {
        Points points;
        while (id.starts_with(':') && lane(id)) {
            const Points part = points_of(lane(id));
            points.insert(points.end(), part.begin(), part.end());
            const auto next = next_.find(id);
            id = next == next_.end() ? "" : next->second;
        }
        if (lane(id)) {
            const Points part = cut(points_of(lane(id)), way_out).first;
            points.insert(points.end(), part.begin(), part.end());
        }
        return points;
    }

    /// Lanes of a junction that come from another road than this one.
    std::vector<std::string> others(const std::string& junction, const std::string& id) const {
        std::vector<std::string> found;
        const auto inside = inside_.find(junction);
        if (inside != inside_.end())
            for (const std::string& other : inside->second)
                if (origin(other) != origin(id))
                    found.push_back(other);
        return found;
    }

  private:
    std::string origin(const std::string& id) const {
        const auto found = origins_.find(id);
        return found == origins_.end() ? "" : found->second;
    }

    std::map<std::string, pugi::xml_node> lanes_;
    std::map<std::string, std::vector<std::string>> inside_;  ///< [junction]
    std::map<std::string, std::string> next_;                 ///< [internal lane]
    std::map<std::string, std::string> waits_;                ///< [second part] the first one
    std::map<std::string, std::string> origins_;              ///< [internal lane] its road
};

/// [m] that the end of `first` goes back so that nobody of `ways` is hindered but those in whose
/// way it is wherever it ends, as of who turns left from the side; 0: not at all. `others` are ways
/// that it may not be drawn back over: who waits does not look at them again.
double way_back(const Points& first,
                const std::vector<Points>& ways,
                const std::vector<Points>& others) {
    const double length = length_of(first);
    const auto hinders = [&](double back, const Points& way) {
        return in_the_way(cut(first, length - back).first, way);
    };
    const double most = std::min(moved_at_most, length - least_length);
    if (most < tried_every)
        return 0;
    std::vector<const Points*> hindered;
    for (const Points& way : ways)
        if (in_the_way(first, way) && !hinders(length - least_length, way))
            hindered.push_back(&way);
    for (double back = tried_every; !hindered.empty() && back <= most; back += tried_every) {
        const auto in_way = [&](const Points* way) { return hinders(back, *way); };
        if (std::any_of(hindered.begin(), hindered.end(), in_way))
            continue;
        const Points moved = cut(first, length - back).second;
        const bool over = std::any_of(
            others.begin(), others.end(), [&](const Points& other) { return cross(moved, other); });
        return over ? 0 : back;
    }
    return 0;
}

void move_back(pugi::xml_node first, pugi::xml_node second, double back) {
    const Points whole = points_of(first);
    const double drawn = length_of(whole);
    auto [kept, moved] = cut(whole, drawn - back);
    const Points rest = points_of(second);
    moved.insert(moved.end(), rest.begin(), rest.end());
    const bool heights = has_heights(first) || has_heights(second);
    const double length = number(first.attribute("length").value(), drawn);
    const double part = length * back / drawn;
    const double after = number(second.attribute("length").value(), length_of(rest));
    first.attribute("shape").set_value(shape_text(kept, heights).c_str());
    second.attribute("shape").set_value(shape_text(moved, heights).c_str());
    first.attribute("length").set_value(fmt::format("{:.3f}", length - part).c_str());
    second.attribute("length").set_value(fmt::format("{:.3f}", after + part).c_str());
}

/// Each place by itself, as the others are by now.
std::size_t move_each(pugi::xml_node net, const Paths& paths) {
    std::size_t moved = 0;
    for (pugi::xml_node junction : net.children("junction")) {
        if (std::string_view(junction.attribute("type").value()) != "internal")
            continue;
        const std::string second = junction.attribute("id").value();
        const std::string first = paths.first_part(second);
        const pugi::xml_node first_lane = paths.lane(first);
        const pugi::xml_node second_lane = paths.lane(second);
        if (!first_lane || !second_lane)
            continue;
        std::vector<std::string> known;
        for (const std::string_view word : world::words(junction.attribute("intLanes").value()))
            known.emplace_back(word);
        std::vector<Points> ways;
        std::vector<Points> others;
        for (const std::string& id :
             paths.others(junction_around(second.substr(0, second.rfind('_'))), second)) {
            const std::string before = paths.first_part(id);
            const bool is_known = std::count(known.begin(), known.end(), id) > 0;
            if (is_known)
                ways.push_back(paths.from(id));
            else if (before.empty() || std::count(known.begin(), known.end(), before) == 0)
                others.push_back(points_of(paths.lane(id)));
        }
        const double back = way_back(points_of(first_lane), ways, others);
        if (back == 0)
            continue;
        move_back(first_lane, second_lane, back);
        const Eigen::Vector3d place = points_of(second_lane).front();
        junction.attribute("x").set_value(fmt::format("{:.3f}", place.x()).c_str());
        junction.attribute("y").set_value(fmt::format("{:.3f}", place.y()).c_str());
        ++moved;
    }
    return moved;
}

}  // namespace

std::size_t move_waiting_places(pugi::xml_node net) {
    constexpr int rounds = 3;  // a way that begins earlier may be in somebody else's now
    const Paths paths(net);
    std::size_t all = 0;
    for (int round = 0; round < rounds; ++round) {
        const std::size_t moved = move_each(net, paths);
        all += moved;
        if (moved == 0)
            break;
    }
    return all;
}

}  // namespace reprise::towns
