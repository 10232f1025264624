// Must: leave no corner at a junction at which nobody could turn, where the roads have room for it.
// Assumes: lanes whose numbers were checked (network.cpp); backward ways were mended.
// Goes: way by way; the road that begins too early is cut metre by metre until a curve leads onto
//   it; the one that ends too late likewise, seen from its end. Where that is not enough the way
//   is an arc and a straight piece, as wide as there is room for.
// Keeps: nothing.
#include "towns/network/sharp_corners.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "towns/network/drawn_ways.h"
#include "world/geometry2d.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double sharp = -0.3;          ///< cosine of a turn at a joint that nobody drives
constexpr double back = -0.866;         ///< cosine of one within a way that leads nowhere else
constexpr double wide_enough = 0.5;     ///< cosine of what is left to turn at the curve's end
constexpr double furthest = 8;          ///< [m] that is cut off a road
constexpr double cut_step = 0.5;        ///< [m]
constexpr double least_road = 2;        ///< [m] of the road
constexpr double share_of_many = 0.15;  ///< of a road with other lanes, which keep what is cut
constexpr int curve_points = 8;         ///< of a curve
constexpr double widest_swing = 6.5;    ///< [m] radius of a turn that any car can drive
constexpr double least_swing = 4;       ///< [m] of one with the wheels at the stop
constexpr double swung_more = 0.15;     ///< cosine that the joint at the way's other end may lose
constexpr double longest_swing = 3.5;   ///< [rad] of an arc: more would be a loop
constexpr double swing_step = 0.2;      ///< [rad] from point to point

/// What is left of a line behind `cut` metres, and what is cut off, both with the place itself.
struct Cut {
    DrawnLine off;
    DrawnLine left;
};

Cut cut_at(const DrawnLine& line, double cut) {
    if (cut == 0)
        return {{line.front()}, line};
    Cut parts;
    double driven = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (i > 0) {
            const double length = (line[i] - line[i - 1]).norm();
            if (driven < cut && driven + length >= cut) {
                const Vector3d place =
                    line[i - 1] + (line[i] - line[i - 1]) * ((cut - driven) / length);
                parts.off.push_back(place);
                parts.left.push_back(place);
            }
            driven += length;
        }
        if (driven < cut)
            parts.off.push_back(line[i]);
        else if (parts.left.empty() || (line[i] - parts.left.back()).norm() > 1e-3)
            parts.left.push_back(line[i]);
    }
    return parts;
}

/// From one place and direction to another.
DrawnLine curve(const Vector3d& from,
                const Vector2d& ahead,
                const Vector3d& to,
                const Vector2d& onto) {
    const double reach = 0.4 * (to - from).norm();
    Vector3d out = from, in = to;
    out.head<2>() += reach * ahead;
    in.head<2>() -= reach * onto;
    DrawnLine line;
    for (int i = 0; i < curve_points; ++i) {
        const double t = static_cast<double>(i) / (curve_points - 1), u = 1 - t;
        line.push_back(u * u * u * from + 3 * u * u * t * out + 3 * u * t * t * in +
                       t * t * t * to);
    }
    return line;
}

/// Where a road may begin that one comes to from `end` in the direction `came`.
std::optional<Cut> begin_behind(const DrawnLine& road,
                                const Vector3d& end,
                                const Vector2d& came,
                                double most) {
    const double metres = drawn_metres(road);
    for (double cut = cut_step; cut <= most && cut <= metres - least_road; cut += cut_step) {
        Cut parts = cut_at(road, cut);
        const Vector2d chord = (parts.left.front() - end).head<2>();
        if (chord.norm() > 1 && chord.normalized().dot(first_direction(parts.left)) > wide_enough &&
            chord.dot(came) >= 0)
            return parts;
    }
    return std::nullopt;
}

/// On an arc until it points to the other place, then straight. None: the place is too near for it,
/// or one would drive in a circle.
std::optional<DrawnLine> swing(const Vector3d& from,
                               const Vector2d& ahead,
                               const Vector3d& to,
                               double radius) {
    constexpr double whole = 2 * std::numbers::pi;
    const Vector2d gap = (to - from).head<2>();
    const double side = world::cross(ahead, gap) > 0 ? 1 : -1;
    const Vector2d inward = side * world::turned_left(ahead);
    // Seen from the circle's middle, in the direction of the turn.
    const Vector2d to_end = gap - radius * inward;
    const double far = to_end.norm();
    if (far <= radius)
        return std::nullopt;
    const double end_at = std::atan2(to_end.dot(ahead), -to_end.dot(inward));
    const double turned = std::fmod(end_at - std::acos(radius / far) + 2 * whole, whole);
    if (turned > longest_swing)
        return std::nullopt;
    DrawnLine line{from};
    const int steps = static_cast<int>(std::ceil(turned / swing_step));
    const double length = radius * turned + std::sqrt(far * far - radius * radius);
    for (int i = 1; i <= steps; ++i) {
        const double angle = turned * i / steps;
        Vector3d place = from + (to - from) * (radius * angle / length);
        place.head<2>() =
            from.head<2>() + radius * (std::sin(angle) * ahead + (1 - std::cos(angle)) * inward);
        line.push_back(place);
    }
    line.push_back(to);
    return line;
}

/// How a road begins anew, and the way onto it.
struct Mended {
    Cut road;
    DrawnLine way;
};

/// `way` leads onto the road, from where one comes in the direction `came`; at most `most` metres
/// of the road are cut off.
std::optional<Mended> mend(const DrawnLine& road,
                           const DrawnLine& way,
                           const Vector2d& came,
                           double most) {
    const Vector3d& end = way.front();
    const double gentle = std::min(wide_enough, first_direction(way).dot(came) - swung_more);
    if (const auto parts = begin_behind(road, end, came, most))
        return Mended{*parts, curve(end, came, parts->left.front(), first_direction(parts->left))};
    const double cuttable = std::max(0.0, std::min(most, drawn_metres(road) - least_road));
    // Seen from the road, so that it ends in its direction.
    for (double radius = widest_swing; radius >= least_swing; radius -= 0.5)
        for (double cut = 0; cut <= cuttable; cut += cut_step) {
            const Cut parts = cut_at(road, cut);
            const auto swung = swing(parts.left.front(), -first_direction(parts.left), end, radius);
            if (swung && first_direction(reversed(*swung)).dot(came) > gentle)
                return Mended{parts, reversed(*swung)};
        }
    return std::nullopt;
}

/// A sidewalk beside it stays as it is.
bool is_sidewalk(const pugi::xml_node& lane) {
    return std::string_view(lane.attribute("allow").value()) == "pedestrian";
}

double most_of(const DrawnWays::Lane& lane) {
    const auto all = lane.node.parent().children("lane");
    const bool is_one = std::count_if(all.begin(), all.end(), std::not_fn(is_sidewalk)) == 1;
    return is_one ? furthest : std::min(furthest, share_of_many * drawn_metres(lane.line));
}

/// At the joint of two lines.
bool is_sharp(const DrawnLine& before, const DrawnLine& behind) {
    return before.size() > 1 && behind.size() > 1 &&
           -first_direction(reversed(before)).dot(first_direction(behind)) <= sharp;
}

/// The road behind the way begins later.
bool mend_end(DrawnWays& lanes, const DrawnWays::Way& way) {
    const DrawnLine last = lanes.at(way.last).line;
    const DrawnLine road = lanes.at(way.to).line;
    if (!is_sharp(last, road))
        return false;
    const Vector2d came = way.last == way.via
                              ? Vector2d(-first_direction(reversed(lanes.at(way.from).line)))
                              : first_direction(last);
    const auto mended = mend(road, last, came, most_of(lanes.at(way.to)));
    if (!mended)
        return false;
    for (const std::string& onto : lanes.at(way.to).before) {
        DrawnLine line = lanes.at(onto).line;
        line.insert(line.end(), mended->road.off.begin() + 1, mended->road.off.end());
        lanes.redraw(onto, onto == way.last ? mended->way : line);
    }
    lanes.redraw(way.to, mended->road.left);
    return true;
}

/// The road before the way ends earlier.
bool mend_start(DrawnWays& lanes, const DrawnWays::Way& way) {
    const DrawnLine first = lanes.at(way.via).line;
    if (!is_sharp(lanes.at(way.from).line, first))
        return false;
    const DrawnLine road = reversed(lanes.at(way.from).line);
    const Vector2d goes = way.last == way.via ? first_direction(lanes.at(way.to).line)
                                              : Vector2d(-first_direction(reversed(first)));
    const auto mended = mend(road, reversed(first), -goes, most_of(lanes.at(way.from)));
    if (!mended)
        return false;
    for (const std::string& off : lanes.at(way.from).behind) {
        const DrawnLine gone = reversed(mended->road.off);
        DrawnLine line = lanes.at(off).line;
        line.insert(line.begin(), gone.begin(), gone.end() - 1);
        lanes.redraw(off, off == way.via ? reversed(mended->way) : line);
    }
    lanes.redraw(way.from, reversed(mended->road.left));
    return true;
}

/// The first point within a line at which it turns back; 0: there is none.
std::size_t corner_within(const DrawnLine& line) {
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const Vector2d in = (line[i] - line[i - 1]).head<2>().normalized();
        const Vector2d out = (line[i + 1] - line[i]).head<2>().normalized();
        if (in.dot(out) <= back)
            return i;
    }
    return 0;
}

/// The way goes out over the junction and comes back by a corner: it goes out as far as it needs
/// to turn on an arc.
bool mend_within(DrawnWays& lanes, const DrawnWays::Way& way) {
    const DrawnLine line = lanes.at(way.via).line;
    const std::size_t corner = corner_within(line);
    if (way.last != way.via || corner == 0)
        return false;
    const DrawnLine out(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(corner) + 1);
    const Vector2d onto = first_direction(lanes.at(way.to).line);
    for (double driven = 0; driven < drawn_metres(out); driven += cut_step)
        for (double radius = widest_swing; radius >= least_swing; radius -= 0.5) {
            const Cut parts = cut_at(out, driven);
            const auto swung =
                swing(parts.off.back(), first_direction(parts.left), line.back(), radius);
            if (!swung || -first_direction(reversed(*swung)).dot(onto) < wide_enough)
                continue;
            DrawnLine drawn = parts.off;
            drawn.insert(drawn.end(), swung->begin() + 1, swung->end());
            lanes.redraw(way.via, drawn);
            return true;
        }
    return false;
}

}  // namespace

std::size_t mend_sharp_corners(pugi::xml_node net) {
    DrawnWays lanes(net);
    std::size_t mended = 0;
    for (const DrawnWays::Way& way : lanes.ways()) {
        if (way.turns_round)
            continue;
        const bool end = mend_end(lanes, way);
        const bool start = mend_start(lanes, way);
        const bool within = mend_within(lanes, way);
        mended += end || start || within ? 1 : 0;
    }
    return mended;
}

}  // namespace reprise::towns
