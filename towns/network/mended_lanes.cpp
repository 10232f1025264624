// Must: make lanes fit to be driven on, for SUMO and for us alike: both read the network that comes
//   out.
// Assumes: lanes whose numbers were checked (network.cpp).
// Goes: lane by lane; words of a shape are left out, never rewritten; lengths by road, because SUMO
//   has one length for all lanes of an edge.
// Keeps: nothing.
#include "towns/network/mended_lanes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/check/lane_check.h"
#include "towns/network/network_xml.h"
#include "world/geometry2d.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using std::string_view;

constexpr double longest_fold = 10;     ///< [m] back over the line; what is longer was drawn so
constexpr double longest_inside = 1;    ///< [m] within a junction, where one may turn around
constexpr double same_place = 1e-3;     ///< [m]
constexpr double narrowest_lane = 0.1;  ///< [m]
constexpr double off_length = 1.1;      ///< drawn over counted, or the other way round

std::vector<Vector2d> places_of(const std::vector<string_view>& points) {
    std::vector<Vector2d> places;
    for (const string_view point : points)
        places.push_back(world::in_plan(parse_shape(point).front()));
    return places;
}

/// The point that a fold of the line is rid of by leaving it out; none: there is no fold.
std::optional<std::size_t> fold_in(const std::vector<Vector2d>& line, double longest) {
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const double before = (line[i] - line[i - 1]).norm();
        const double after = (line[i + 1] - line[i]).norm();
        const bool closes = (line[i + 1] - line[i - 1]).norm() < same_place && line.size() == 3;
        if (std::min(before, after) <= longest && !closes && turn_at(line, i) > sharpest_turn)
            return i;
    }
    return std::nullopt;
}

bool unfold(pugi::xml_node lane, double longest) {
    std::vector<string_view> points;
    for (const string_view point : world::words(lane.attribute("shape").value()))
        points.push_back(point);
    std::vector<Vector2d> line = places_of(points);
    const std::size_t drawn = points.size();
    // A point that is there twice would hide the turn at it.
    for (std::size_t i = line.size(); i-- > 1;)
        if ((line[i] - line[i - 1]).norm() < same_place && line.size() > 2) {
            const auto at = static_cast<std::ptrdiff_t>(i + 1 < line.size() ? i : i - 1);
            line.erase(line.begin() + at);
            points.erase(points.begin() + at);
        }
    const std::size_t distinct = points.size();
    for (auto fold = fold_in(line, longest); fold; fold = fold_in(line, longest)) {
        line.erase(line.begin() + static_cast<std::ptrdiff_t>(*fold));
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(*fold));
    }
    if (points.size() == distinct || drawn == 0)
        return false;
    std::string shape;
    for (const string_view point : points)
        shape.append(shape.empty() ? "" : " ").append(point);
    lane.attribute("shape").set_value(shape.c_str());
    return true;
}

double drawn_length(pugi::xml_node lane) {
    const auto line = parse_shape(lane.attribute("shape").value());
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += std::hypot(line[i].x() - line[i - 1].x(),
                             line[i].y() - line[i - 1].y(),
                             line[i].z() - line[i - 1].z());
    return length;
}

bool are_unlike(double one, double other) {
    return std::max(one, other) > off_length * std::min(one, other) && std::abs(one - other) > 1;
}

/// Lanes that SUMO pairs with those of another road must have its length: they stay.
bool is_paired(pugi::xml_node edge) {
    return edge.attribute("bidi") ||
           std::any_of(edge.children("lane").begin(),
                       edge.children("lane").end(),
                       [](pugi::xml_node lane) { return lane.child("neigh"); });
}

bool measure_again(pugi::xml_node edge) {
    std::vector<double> drawn;
    bool is_off = false;
    for (const pugi::xml_node lane : edge.children("lane")) {
        drawn.push_back(drawn_length(lane));
        is_off = is_off || are_unlike(drawn.back(), number(lane.attribute("length").value(), 0));
    }
    if (!is_off || is_paired(edge))
        return false;
    const auto [shortest, longest] = std::minmax_element(drawn.begin(), drawn.end());
    double mean = 0;
    for (const double length : drawn)
        mean += length / static_cast<double>(drawn.size());
    // In a bend lanes differ, and the mean is what SUMO has; there is nothing better to say.
    const double counted = number(edge.child("lane").attribute("length").value(), 0);
    if (mean < 1 || !are_unlike(mean, counted) || *longest > 2 * *shortest)
        return false;
    for (pugi::xml_node lane : edge.children("lane"))
        lane.attribute("length").set_value(fmt::format("{:.2f}", mean).c_str());
    return true;
}

bool close_lane(pugi::xml_node lane) {
    const string_view width = lane.attribute("width").value();
    if (width.empty() || number(width, 0) > 0)
        return false;
    lane.attribute("width").set_value(fmt::format("{:.2f}", narrowest_lane).c_str());
    lane.remove_attribute("allow");
    lane.remove_attribute("disallow");
    lane.append_attribute("disallow").set_value("all");
    return true;
}

}  // namespace

MendedLanes mend_lanes(pugi::xml_node net) {
    MendedLanes mended;
    for (const pugi::xml_node edge : net.children("edge")) {
        const string_view function = edge.attribute("function").value();
        if (function == "walkingarea" || function == "crossing")
            continue;
        const bool is_inside = function == "internal";
        for (const pugi::xml_node lane : edge.children("lane")) {
            mended.folds += unfold(lane, is_inside ? longest_inside : longest_fold) ? 1U : 0U;
            mended.closed += close_lane(lane) ? 1U : 0U;
        }
        // Lanes of a turn within a junction differ as much as its inside from its outside.
        if (!is_inside)
            mended.lengths += measure_again(edge) ? 1U : 0U;
    }
    return mended;
}

}  // namespace reprise::towns
