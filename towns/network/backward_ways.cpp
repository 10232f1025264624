// Must: leave no way through a junction that runs against the roads before and behind it, where
//   these can be cut; touch nothing else.
// Assumes: lanes whose numbers were checked (network.cpp).
// Goes: way by way; of the lanes that it joins each knows all its ways, whose ends go along.
// Keeps: nothing.
#include "towns/network/backward_ways.h"

#include <map>
#include <string>

#include <pugixml.hpp>

#include "towns/network/drawn_ways.h"

namespace reprise::towns {

namespace {

using Line = DrawnLine;
using Lanes = DrawnWays;

constexpr double against = -0.85;     ///< cosine of a turn that nobody drives
constexpr double longest_reach = 30;  ///< [m] what is longer was drawn so
constexpr double least_left = 1;      ///< [m] of a lane that is cut,
constexpr double least_way = 0.2;     ///< of a way, and of a lane that is nothing but moved

/// What is left of a line that is to begin here, and leads in this direction at first.
Line from_here(const Line& line, const Eigen::Vector3d& begin, const Eigen::Vector2d& ahead) {
    Line left{begin};
    for (const Eigen::Vector3d& point : line)
        if (left.size() > 1 || (point - begin).head<2>().dot(ahead) > least_way / 2)
            left.push_back(point);
    return left;
}

/// The second lane begins where the first one ends, and a little further on.
bool cut_second(Lanes& lanes, const Lanes::Way& way, const Eigen::Vector2d& ahead) {
    const Lanes::Lane& to = lanes.at(way.to);
    Eigen::Vector3d begin = lanes.at(way.from).line.back();
    begin.head<2>() += least_way * ahead;
    const Line left = from_here(to.line, begin, ahead);
    if (drawn_metres(left) < least_left || left.size() < 2)
        return false;
    for (const std::string& onto : to.before) {
        Line line = lanes.at(onto).line;
        line.push_back(begin);
        lanes.redraw(onto, onto == way.via ? Line{lanes.at(way.from).line.back(), begin} : line);
    }
    lanes.redraw(way.to, left);
    return true;
}

/// The first lane ends a little before the second one begins.
bool cut_first(Lanes& lanes, const Lanes::Way& way, const Eigen::Vector2d& ahead) {
    const Lanes::Lane& from = lanes.at(way.from);
    const Eigen::Vector3d begin = lanes.at(way.to).line.front();
    Eigen::Vector3d end = begin;
    end.head<2>() -= least_way * ahead;
    Line left = reversed(from_here(reversed(from.line), end, -ahead));
    const bool is_moved = drawn_metres(left) < least_left || left.size() < 2;
    if (is_moved) {
        Eigen::Vector3d start = end;
        start.head<2>() -= least_way * ahead;
        std::map<std::string, Line> onto;
        for (const std::string& each : from.before) {
            const Line& line = lanes.at(each).line;
            onto[each] = reversed(from_here(reversed(line), start, -ahead));
            const bool turns_round = first_direction(line).dot(ahead) < 0;
            if (onto[each].size() < 2 && turns_round)
                onto[each] = {line.front(), start};
            if (onto[each].size() < 2 || drawn_metres(onto[each]) < least_left)
                return false;
        }
        for (const auto& [id, line] : onto)
            lanes.redraw(id, line);
        left = {start, end};
    }
    for (const std::string& off : from.behind) {
        Line line = lanes.at(off).line;
        line.insert(line.begin(), end);
        lanes.redraw(off, off == way.via ? Line{end, begin} : line);
    }
    lanes.redraw(way.from, left);
    return true;
}

bool mend(Lanes& lanes, const Lanes::Way& way) {
    const Lanes::Lane& from = lanes.at(way.from);
    const Lanes::Lane& to = lanes.at(way.to);
    const Line& via = lanes.at(way.via).line;
    if (via.size() < 2 || from.line.size() < 2 || to.line.size() < 2)
        return false;
    const Eigen::Vector2d along = first_direction(via);
    const Eigen::Vector2d ahead = first_direction(to.line);
    const Eigen::Vector2d came = -first_direction(reversed(from.line));
    const double reach = (via.back() - via.front()).head<2>().norm();
    if (reach > longest_reach || along.dot(ahead) > against || along.dot(came) > against)
        return false;
    const bool second = drawn_metres(to.line) > drawn_metres(from.line);
    return (second && cut_second(lanes, way, ahead)) || cut_first(lanes, way, ahead) ||
           (!second && cut_second(lanes, way, ahead));
}

}  // namespace

std::size_t mend_backward_ways(pugi::xml_node net) {
    Lanes lanes(net);
    std::size_t mended = 0;
    for (const Lanes::Way& way : lanes.ways())
        mended += mend(lanes, way) ? 1 : 0;
    return mended;
}

}  // namespace reprise::towns
