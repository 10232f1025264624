// Must: draw the lines that road networks do not hold, from what they do hold.
// Assumes: neighbours and opposite lanes are known; the road is a ribbon with mitred corners.
// Goes: a line is a thin ribbon along the road ribbon's own edge, so that it follows the same
// slopes;
//   dashes are stretches of it.
// Keeps: every line 5 mm above the road: nearer, and a depth picture cannot tell them apart.
#include <algorithm>
#include <set>
#include <string_view>

#include "world/ground.h"
#include "world/ground_builder.h"
#include "world/junction_surface.h"
#include "world/ribbon.h"
#include "world/tick.h"

namespace reprise::world {

namespace {

using Line = std::vector<Eigen::Vector3d>;

constexpr double paint_height = 0.005;   ///< [m] above the road
constexpr double line_width = 0.12;      ///< [m]
constexpr double dash_length = 3.0;      ///< [m]
constexpr double dash_period = 9.0;      ///< [m]
constexpr double edge_inset = 0.15;      ///< [m] of edge lines from the road's edge
constexpr double stop_line_width = 0.4;  ///< [m] along the lane
constexpr double stop_line_gap = 0.4;    ///< [m] to the lane's end
constexpr double shortest_marked = 3.0;  ///< [m] shorter lanes carry no stop line
constexpr double stripe_width = 0.5;     ///< [m] of a zebra stripe, and of the gap behind it

double length_of(const Line& line) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        length += (line[i + 1] - line[i]).norm();
    return length;
}

/// The part of a line between two arc lengths, from < to.
Line stretch(const Line& line, double from, double to) {
    constexpr double shortest = 1e-3;
    Line part;
    double passed = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector3d along = line[i + 1] - line[i];
        const double length = along.norm();
        const double first = std::max(from, passed);
        const double last = std::min(to, passed + length);
        if (last - first > shortest) {
            if (part.empty())
                part.push_back(line[i] + along * ((first - passed) / length));
            part.push_back(line[i] + along * ((last - passed) / length));
        }
        passed += length;
    }
    return part;
}

class Painter {
  public:
    explicit Painter(const TownT& town);

    void paint_lane(std::uint32_t index);
    void paint_crossings();

    GroundMesh take() { return builder_.take(); }

  private:
    void paint(const Line& line, double width);
    void paint_dashed(const Line& line);
    void paint_inner_edge(std::uint32_t index, const Line& centre);
    void paint_outer_edge(const LaneT& lane, const Line& centre);
    void paint_stop_line(const LaneT& lane, const Line& centre);
    void paint_zebra(const LaneT& lane, const SurfaceHeight& road);

    const TownT& town_;
    std::set<std::string_view> edges_with_sidewalk_;
    double inward_;  ///< sign of the side where the road's middle is: +1 left
    GroundBuilder builder_;
};

Painter::Painter(const TownT& town) : town_(town), inward_(town.left_hand ? -1 : 1) {
    for (const LaneT& lane : town.lanes)
        if (lane.kind == LaneKind::sidewalk)
            edges_with_sidewalk_.insert(lane.edge);
}

void Painter::paint(const Line& line, double width) {
    if (line.size() < 2)
        return;
    for (std::vector<Eigen::Vector3d> piece : make_ribbon(line, -width / 2, width / 2).pieces) {
        for (Eigen::Vector3d& corner : piece)
            corner.z() += paint_height;
        builder_.add_face(piece, Surface::marking);
    }
}

void Painter::paint_dashed(const Line& line) {
    const double length = length_of(line);
    // Half a gap at both ends, so that the pattern runs on across a seam of two lanes.
    for (double s = (dash_period - dash_length) / 2; s + dash_length <= length; s += dash_period)
        paint(stretch(line, s, s + dash_length), line_width);
}

void Painter::paint_inner_edge(std::uint32_t index, const Line& centre) {
    const LaneT& lane = town_.lanes[index];
    const std::uint32_t inner = town_.left_hand ? lane.right : lane.left;
    const double edge = inward_ * lane.width / 2;
    if (inner != none) {
        paint_dashed(moved_left(centre, edge));
    } else if (lane.opposite == none) {
        paint(moved_left(centre, edge - inward_ * edge_inset), line_width);
    } else {
        // Both directions know of the line between them; the one with the lower index draws it.
        const bool is_mutual =
            lane.opposite < town_.lanes.size() && town_.lanes[lane.opposite].opposite == index;
        if (!is_mutual || index < lane.opposite)
            paint(moved_left(centre, edge), line_width);
    }
}

void Painter::paint_outer_edge(const LaneT& lane, const Line& centre) {
    const std::uint32_t outer = town_.left_hand ? lane.left : lane.right;
    if (outer != none || edges_with_sidewalk_.contains(lane.edge))
        return;
    paint(moved_left(centre, -inward_ * (lane.width / 2 - edge_inset)), line_width);
}

void Painter::paint_stop_line(const LaneT& lane, const Line& centre) {
    // A left turn that gives way to oncoming traffic does not make a priority road stop.
    const bool has_signal = std::any_of(lane.links.begin(), lane.links.end(), [](const Link& link) {
        return link.signal() != none;
    });
    const bool gives_way = !lane.links.empty() &&
                           std::all_of(lane.links.begin(), lane.links.end(), [](const Link& link) {
                               return link.yields();
                           });
    const double length = length_of(centre);
    if ((!has_signal && !gives_way) || length < shortest_marked)
        return;
    const double end = length - stop_line_gap;
    paint(stretch(centre, end - stop_line_width, end), lane.width - 2 * line_width);
}

void Painter::paint_lane(std::uint32_t index) {
    const LaneT& lane = town_.lanes[index];
    if (lane.kind != LaneKind::driving)
        return;
    const Line centre = clean_line(lane.centre);
    paint_inner_edge(index, centre);
    paint_outer_edge(lane, centre);
    paint_stop_line(lane, centre);
}

void Painter::paint_zebra(const LaneT& lane, const SurfaceHeight& road) {
    const Line centre = clean_line(lane.centre);
    const double length = length_of(centre);
    const auto height = [&](const Eigen::Vector2d& p) { return road.at(p) + paint_height; };
    const double cell = road.is_plane() ? 0 : surface_cell;
    for (double s = stripe_width / 2; s + stripe_width <= length; s += 2 * stripe_width) {
        const Line stripe = stretch(centre, s, s + stripe_width);
        if (stripe.size() < 2)
            continue;
        const Ribbon ribbon = make_ribbon(stripe, -lane.width / 2, lane.width / 2);
        for (const Loop& loop : ribbon.loops())
            builder_.add_face(loop, height, cell, Surface::marking);
    }
}

void Painter::paint_crossings() {
    const std::vector<JunctionParts> parts = parts_of_junctions(town_);
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const SurfaceHeight road = height_of_junction(town_, i, parts[i]);
        for (const std::uint32_t crossing : parts[i].crossings)
            paint_zebra(town_.lanes[crossing], road);
    }
    for (const LaneT& lane : town_.lanes)
        if (lane.kind == LaneKind::crossing && lane.junction >= parts.size())
            paint_zebra(lane, SurfaceHeight::along(clean_line(lane.centre)));
}

}  // namespace

GroundMesh build_markings(const TownT& town) {
    Painter painter(town);
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        painter.paint_lane(i);
    painter.paint_crossings();
    return painter.take();
}

}  // namespace reprise::world
