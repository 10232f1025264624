#include "towns/network/drawn_ways.h"

#include <algorithm>

#include <fmt/format.h>

#include "towns/network/network_xml.h"
#include "world/frames.h"

namespace reprise::towns {

namespace {

DrawnLine lane_line(pugi::xml_node lane) {
    DrawnLine line;
    for (const world::Vec3& point : parse_shape(lane.attribute("shape").value()))
        line.push_back(world::to_eigen(point));
    return line;
}

}  // namespace

double drawn_metres(const DrawnLine& line) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += (line[i] - line[i - 1]).norm();
    return length;
}

Eigen::Vector2d first_direction(const DrawnLine& line) {
    for (std::size_t i = 1; i < line.size(); ++i)
        if (const Eigen::Vector2d way = (line[i] - line.front()).head<2>(); way.norm() > 1e-3)
            return way.normalized();
    return Eigen::Vector2d::Zero();
}

DrawnLine reversed(DrawnLine line) {
    std::reverse(line.begin(), line.end());
    return line;
}

DrawnWays::DrawnWays(pugi::xml_node net) {
    for (const pugi::xml_node edge : net.children("edge"))
        for (const pugi::xml_node lane : edge.children("lane"))
            lanes_[lane.attribute("id").value()] = {lane, lane_line(lane), {}, {}};
    std::map<std::string, std::string> second;  // [first lane of a way]
    for (const pugi::xml_node connection : net.children("connection"))
        take(connection);
    for (const pugi::xml_node connection : net.children("connection"))
        if (const std::string edge = connection.attribute("from").value(); edge.starts_with(':'))
            if (const std::string via = connection.attribute("via").value(); lanes_.contains(via))
                second[edge + "_" + connection.attribute("fromLane").value()] = via;
    for (Way& way : ways_)
        if (const auto part = second.find(way.via); part != second.end())
            way.last = part->second;
}

void DrawnWays::redraw(const std::string& id, const DrawnLine& line) {
    Lane& lane = lanes_.at(id);
    lane.line = line;
    const bool is_flat =
        std::all_of(line.begin(), line.end(), [](const auto& p) { return p.z() == 0; });
    std::string shape;
    for (const Eigen::Vector3d& p : line) {
        shape += fmt::format("{}{:.3f},{:.3f}", shape.empty() ? "" : " ", p.x(), p.y());
        if (!is_flat)
            shape += fmt::format(",{:.3f}", p.z());
    }
    lane.node.attribute("shape").set_value(shape.c_str());
    const std::string length = fmt::format("{:.3f}", drawn_metres(line));
    for (pugi::xml_node each : lane.node.parent().children("lane"))
        each.attribute("length").set_value(length.c_str());
}

void DrawnWays::take(pugi::xml_node connection) {
    const auto id = [&](const char* edge, const char* lane) {
        return std::string(connection.attribute(edge).value()) + "_" +
               connection.attribute(lane).value();
    };
    const std::string from = id("from", "fromLane");
    const std::string via = connection.attribute("via").value();
    const std::string to = id("to", "toLane");
    if (!lanes_.contains(from) || !lanes_.contains(to))
        return;
    if (from.starts_with(':')) {
        if (via.empty())
            lanes_[to].before.insert(from);
    } else if (lanes_.contains(via)) {
        lanes_[from].behind.insert(via);
        const std::string turn = connection.attribute("dir").value();
        ways_.push_back({from, via, via, to, turn == "t"});
    }
}

}  // namespace reprise::towns
