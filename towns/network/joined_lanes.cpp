#include "towns/network/joined_lanes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <pugixml.hpp>

#include "towns/check/lane_check.h"
#include "towns/network/junction_links.h"
#include "towns/network/network_xml.h"
#include "world/geometry2d.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using std::string_view;

constexpr double apart = 2.8;    // [m] between middles: two buses of 2.55 m pass each other
constexpr double gentle = 30.0;  // [m] radius in which no corner of a bus leaves its lane

/// One way through a junction, and the line that it goes.
struct Way : JunctionLink {
    std::vector<Vector2d> line;
};

/// The links and lanes of a network.
class Ways {
  public:
    explicit Ways(pugi::xml_node net) : links_(net) {
        for (const pugi::xml_node edge : net.children("edge"))
            for (const pugi::xml_node lane : edge.children("lane"))
                lanes_[lane.attribute("id").value()] = lane;
    }

    std::vector<Way> through(pugi::xml_node junction) const {
        std::vector<Way> ways;
        for (const JunctionLink& link : links_.through(junction))
            ways.push_back({link, line_of(link.xml)});
        return ways;
    }

  private:
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
            const auto& next = links_.from(via);
            via = next.empty() ? "" : next.front().attribute("via").value();
        }
        return line;
    }

    JunctionLinks links_;
    std::map<string_view, pugi::xml_node> lanes_;
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

bool have_nothing_to_do_with_each_other(const Way& one, const Way& other) {
    return one.from != other.from && one.to == other.to && one.lane != other.lane &&
           is_gentle(one.line) && is_gentle(other.line) && keep_apart(one.line, other.line);
}

}  // namespace

std::size_t part_joined_lanes(pugi::xml_node net) {
    const Ways all(net);
    std::size_t parted = 0;
    for (const pugi::xml_node junction : net.children("junction")) {
        JunctionRows rows(junction);
        const std::size_t before = parted;
        const std::vector<Way> ways = all.through(junction);
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
            if (parted > before && *way.xml.attribute("state").value() == 'm' &&
                rows.given_way(way.index) == 0)
                way.xml.attribute("state").set_value("M");
    }
    return parted;
}

}  // namespace reprise::towns
