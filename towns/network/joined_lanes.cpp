#include "towns/network/joined_lanes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <pugixml.hpp>

#include "towns/check/lane_check.h"
#include "towns/network/network_xml.h"
#include "world/geometry2d.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using std::string_view;

constexpr double apart = 2.8;    // [m] between middles: two buses of 2.55 m pass each other
constexpr double gentle = 30.0;  // [m] radius in which no corner of a bus leaves its lane

/// One way through a junction, of those who do not walk.
struct Way {
    std::size_t index = 0;  ///< of its link in the junction
    pugi::xml_node link;
    string_view from, to, lane;
    std::vector<Vector2d> line;
};

std::string lane_of(pugi::xml_node link, const char* edge, const char* index) {
    return std::string(link.attribute(edge).value()) + "_" + link.attribute(index).value();
}

/// The links and lanes of a network.
class Links {
  public:
    explicit Links(pugi::xml_node net) {
        for (const pugi::xml_node edge : net.children("edge")) {
            functions_[edge.attribute("id").value()] = edge.attribute("function").value();
            for (const pugi::xml_node lane : edge.children("lane"))
                lanes_[lane.attribute("id").value()] = lane;
        }
        for (const pugi::xml_node link : net.children("connection"))
            links_[lane_of(link, "from", "fromLane")].push_back(link);
    }

    /// Numbered as SUMO does it: lane by lane into the junction, walkers on crossings among them.
    std::vector<Way> ways_through(pugi::xml_node junction) const {
        std::vector<Way> ways;
        std::size_t index = 0;
        for (const string_view lane : world::words(junction.attribute("incLanes").value()))
            for (const pugi::xml_node link : links_from(lane)) {
                const string_view to = function(link, "to");
                const bool walks = function(link, "from") == "walkingarea";
                if (to == "walkingarea" || (walks && to != "crossing"))
                    continue;
                if (!walks && *link.attribute("via").value() != '\0')
                    ways.push_back({index,
                                    link,
                                    link.attribute("from").value(),
                                    link.attribute("to").value(),
                                    link.attribute("toLane").value(),
                                    line_of(link)});
                ++index;
            }
        return ways;
    }

  private:
    const std::vector<pugi::xml_node>& links_from(string_view lane) const {
        static const std::vector<pugi::xml_node> none;
        const auto found = links_.find(lane);
        return found == links_.end() ? none : found->second;
    }

    string_view function(pugi::xml_node link, const char* end) const {
        const auto found = functions_.find(link.attribute(end).value());
        return found == functions_.end() ? "" : found->second;
    }

    /// From lane to lane, as long as there is one inside the junction.
    std::vector<Vector2d> line_of(pugi::xml_node link) const {
        std::vector<Vector2d> line;
        string_view via = link.attribute("via").value();
        for (std::size_t parts = 0; !via.empty() && parts < 8; ++parts) {
            const auto lane = lanes_.find(via);
            if (lane == lanes_.end())
                break;
            for (const world::Vec3& p : parse_shape(lane->second.attribute("shape").value()))
                if (line.empty() || (world::in_plan(p) - line.back()).norm() > 1e-3)
                    line.push_back(world::in_plan(p));
            const auto& next = links_from(via);
            via = next.empty() ? "" : next.front().attribute("via").value();
        }
        return line;
    }

    std::map<string_view, string_view> functions_;  ///< [edge]
    std::map<string_view, pugi::xml_node> lanes_;
    std::map<std::string, std::vector<pugi::xml_node>, std::less<>> links_;  ///< [lane] before them
};

bool is_gentle(const std::vector<Vector2d>& line) {
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const double length = ((line[i] - line[i - 1]).norm() + (line[i + 1] - line[i]).norm()) / 2;
        if (turn_at(line, i) * gentle > length)
            return false;
    }
    return line.size() > 1;
}

bool keep_apart(const std::vector<Vector2d>& one, const std::vector<Vector2d>& other) {
    for (std::size_t i = 0; i + 1 < one.size(); ++i)
        for (std::size_t k = 0; k + 1 < other.size(); ++k)
            if (world::distance_to({one[i], one[i + 1]}, other[k], other[k + 1]) < apart)
                return false;
    return true;
}

/// The rows of a junction: a bit for each of its links in each, the first link rightmost.
class Rows {
  public:
    explicit Rows(pugi::xml_node junction) {
        for (const pugi::xml_node request : junction.children("request"))
            requests_.push_back(request);
    }

    bool are_foes(std::size_t one, std::size_t other) const {
        return has(one, "foes", other) || has(other, "foes", one);
    }

    void part(std::size_t one, std::size_t other) {
        for (const char* row : {"response", "foes"}) {
            clear(one, row, other);
            clear(other, row, one);
        }
    }

    bool lets_nobody_pass(std::size_t index) const {
        return string_view(requests_[index].attribute("response").value()).find('1') ==
               string_view::npos;
    }

  private:
    bool has(std::size_t index, const char* name, std::size_t bit) const {
        if (index >= requests_.size())
            return false;
        const string_view row = requests_[index].attribute(name).value();
        return bit < row.size() && row[row.size() - 1 - bit] == '1';
    }

    void clear(std::size_t index, const char* name, std::size_t bit) {
        if (!has(index, name, bit))
            return;
        std::string row = requests_[index].attribute(name).value();
        row[row.size() - 1 - bit] = '0';
        requests_[index].attribute(name).set_value(row.c_str());
    }

    std::vector<pugi::xml_node> requests_;
};

bool have_nothing_to_do_with_each_other(const Way& one, const Way& other) {
    return one.from != other.from && one.to == other.to && one.lane != other.lane &&
           is_gentle(one.line) && is_gentle(other.line) && keep_apart(one.line, other.line);
}

}  // namespace

std::size_t part_joined_lanes(pugi::xml_node net) {
    const Links links(net);
    std::size_t parted = 0;
    for (const pugi::xml_node junction : net.children("junction")) {
        Rows rows(junction);
        const std::size_t before = parted;
        const std::vector<Way> ways = links.ways_through(junction);
        for (const Way& one : ways)
            for (const Way& other : ways) {
                if (!rows.are_foes(one.index, other.index) ||
                    !have_nothing_to_do_with_each_other(one, other))
                    continue;
                rows.part(one.index, other.index);
                ++parted;
            }
        // Who lets nobody pass any more is on a main road.
        for (Way way : ways)
            if (parted > before && *way.link.attribute("state").value() == 'm' &&
                rows.lets_nobody_pass(way.index))
                way.link.attribute("state").set_value("M");
    }
    return parted;
}

}  // namespace reprise::towns
