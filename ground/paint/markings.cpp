// Must: draw the lines that road networks do not hold, from what they do hold.
// Assumes: neighbours and opposite lanes are known; the road is a ribbon with mitred corners.
// Goes: a line is a thin ribbon along the road ribbon's own edge, so that it follows the same
//   slopes; dashes are stretches of it. Stop lines and arrows: stop_lines.h, turn_arrows.h. Paths
//   through junctions carry no lines.
// Keeps: every line 5 mm above the road.
#include "ground/paint/markings.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "ground/mesh/junction_surface.h"
#include "ground/paint/paint.h"
#include "ground/paint/stop_lines.h"
#include "ground/paint/turn_arrows.h"
#include "world/frames.h"
#include "world/lane_starts.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::ground {

namespace {

constexpr double dash_length = 3.0;      ///< [m]
constexpr double dash_period = 9.0;      ///< [m]
constexpr double edge_inset = 0.15;      ///< [m] of edge lines from the road's edge
constexpr double stripe_width = 0.5;     ///< [m] of a zebra stripe, and of the gap behind it
constexpr double town_limit = 52 / 3.6;  ///< [m/s] above it, centre lines are solid throughout
constexpr double near_junction = 20.0;   ///< [m] before junctions nobody overtakes
constexpr double bend_ahead = 12.0;      ///< [m] looked at, either way
constexpr double bend = 0.3;             ///< [rad] of turn over twice that: radius 80 m

/// Junctions where roads meet; the others only join two pieces of one road.
std::vector<bool> meeting_places(const world::TownT& town) {
    std::vector<std::set<std::string_view>> edges(town.junctions.size());
    std::vector<bool> meets(town.junctions.size());
    for (std::size_t i = 0; i < meets.size(); ++i)
        meets[i] = town.junctions[i].lit;
    for (const world::LaneT& lane : town.lanes) {
        if (lane.junction >= meets.size())
            continue;
        if (lane.kind == world::LaneKind::crossing)
            meets[lane.junction] = true;
        if (lane.kind == world::LaneKind::driving &&
            edges[lane.junction].insert(lane.edge).second && edges[lane.junction].size() > 2)
            meets[lane.junction] = true;
    }
    return meets;
}

class Painter {
  public:
    explicit Painter(const world::TownT& town);

    void paint_lane(std::uint32_t index);
    void paint_crossings();

    GroundMesh take() { return paint_.builder().take(); }

  private:
    void paint_dashed(const Line& line);
    void paint_centre_line(const world::LaneT& lane, const Line& line);
    void paint_inner_edge(std::uint32_t index, const Line& centre);
    void paint_outer_edge(const world::LaneT& lane, const Line& centre);
    void paint_zebra(const world::LaneT& lane, const SurfaceHeight& road);

    const world::TownT& town_;
    std::set<std::string_view> edges_with_sidewalk_;
    std::vector<bool> roads_meet_;  ///< by junction
    double inward_;                 ///< sign of the side where the road's middle is: +1 left
    StopLines stop_lines_;
    Paint paint_;
};

Painter::Painter(const world::TownT& town)
    : town_(town),
      roads_meet_(meeting_places(town)),
      inward_(town.left_hand ? -1 : 1),
      stop_lines_(town) {
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::sidewalk)
            edges_with_sidewalk_.insert(lane.edge);
}

void Painter::paint_dashed(const Line& line) {
    const MeasuredLine measured(line);
    const double length = measured.length();
    // Half a gap at both ends, so that the pattern runs on across a seam of two lanes.
    for (double s = (dash_period - dash_length) / 2; s + dash_length <= length; s += dash_period)
        paint_.line(measured.stretch(s, s + dash_length), line_width);
}

/// Between opposite directions: dashed in towns on roads of one lane each way; solid near
/// junctions, in bends, and on all other roads.
void Painter::paint_centre_line(const world::LaneT& lane, const Line& line) {
    const bool is_wide = lane.left != world::none || lane.right != world::none;
    if (is_wide || lane.speed_limit > town_limit) {
        paint_.line(line, line_width);
        return;
    }
    const auto meets = [&](std::uint32_t junction) {
        return junction < roads_meet_.size() && roads_meet_[junction];
    };
    const MeasuredLine measured(line);
    const double length = measured.length();
    const double scale = lane.length / length;
    const world::LaneStarts starts(lane);
    // Who comes the other way ends where this lane starts.
    const double first_dash = meets(town_.lanes[lane.opposite].junction) ? near_junction : 0;
    const double last_dash = length - (meets(lane.junction) ? near_junction : 0);
    const auto is_bend = [&](double s) {
        const double before = starts.at(lane, (s - bend_ahead) * scale).yaw;
        const double after = starts.at(lane, (s + bend_ahead) * scale).yaw;
        return std::abs(world::wrap_angle(after - before)) > bend;
    };
    constexpr double margin = (dash_period - dash_length) / 2;
    double solid_from = 0;
    for (double s = 0; s < length; s += dash_period) {
        const double next = std::min(s + dash_period, length);
        if (s < first_dash || next > last_dash || is_bend((s + next) / 2))
            continue;
        // What came before is solid as far as this dash's gap.
        if (s > solid_from)
            paint_.line(measured.stretch(solid_from, s), line_width);
        paint_.line(measured.stretch(s + margin, std::min(s + margin + dash_length, next)),
                    line_width);
        solid_from = next;
    }
    if (length > solid_from)
        paint_.line(measured.stretch(solid_from, length), line_width);
}

void Painter::paint_inner_edge(std::uint32_t index, const Line& centre) {
    const world::LaneT& lane = town_.lanes[index];
    const std::uint32_t inner = town_.left_hand ? lane.right : lane.left;
    const double edge = inward_ * lane.width / 2;
    if (inner != world::none) {
        paint_dashed(moved_left(centre, edge));
    } else if (lane.opposite >= town_.lanes.size()) {
        paint_.line(moved_left(centre, edge - inward_ * edge_inset), line_width);
    } else {
        // Both directions know of the line between them; the one with the lower index draws it.
        const bool is_mutual = town_.lanes[lane.opposite].opposite == index;
        if (!is_mutual || index < lane.opposite)
            paint_centre_line(lane, moved_left(centre, edge));
    }
}

void Painter::paint_outer_edge(const world::LaneT& lane, const Line& centre) {
    const std::uint32_t outer = town_.left_hand ? lane.left : lane.right;
    if (outer != world::none || edges_with_sidewalk_.contains(lane.edge))
        return;
    paint_.line(moved_left(centre, -inward_ * (lane.width / 2 - edge_inset)), line_width);
}

void Painter::paint_lane(std::uint32_t index) {
    const world::LaneT& lane = town_.lanes[index];
    if (lane.kind != world::LaneKind::driving)
        return;
    const Line centre = clean_line(lane.centre);
    paint_inner_edge(index, centre);
    paint_outer_edge(lane, centre);
    stop_lines_.paint(index, centre, paint_);
    paint_turn_arrows(town_, index, centre, paint_);
}

void Painter::paint_zebra(const world::LaneT& lane, const SurfaceHeight& road) {
    const Line centre = clean_line(lane.centre);
    const MeasuredLine measured(centre);
    const double length = measured.length();
    const auto height = [&](const Eigen::Vector2d& p) { return road.at(p) + paint_height; };
    const double cell = road.is_plane() ? 0 : surface_cell;
    for (double s = stripe_width / 2; s + stripe_width <= length; s += 2 * stripe_width) {
        const Line stripe = measured.stretch(s, s + stripe_width);
        if (stripe.size() < 2)
            continue;
        const Ribbon ribbon = make_ribbon(stripe, -lane.width / 2, lane.width / 2);
        for (const world::Loop& loop : ribbon.loops())
            paint_.builder().add_face(loop, height, cell, Surface::marking);
    }
}

void Painter::paint_crossings() {
    const std::vector<JunctionParts> parts = parts_of_junctions(town_);
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const SurfaceHeight road = height_of_junction(town_, i, parts[i]);
        for (const std::uint32_t crossing : parts[i].crossings)
            paint_zebra(town_.lanes[crossing], road);
    }
    for (const world::LaneT& lane : town_.lanes)
        if (lane.kind == world::LaneKind::crossing && lane.junction >= parts.size())
            paint_zebra(lane, SurfaceHeight::along(clean_line(lane.centre)));
}

}  // namespace

GroundMesh build_markings(const world::TownT& town) {
    Painter painter(town);
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        painter.paint_lane(i);
    painter.paint_crossings();
    return painter.take();
}

}  // namespace reprise::ground
