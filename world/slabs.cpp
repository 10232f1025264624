// Must: raise sidewalks and walking areas by a kerb's height; keep every path of a car clear of
// them
//   (in real networks they lie on driving lanes by the dozen), and every crossing; close their
//   sides with kerb faces.
// Assumes: nothing of the outlines, which cross themselves or have no area in real networks.
// Goes: each slab on its own - what cuts it is looked up by place and by storey, so that a bridge's
//   lanes do not cut the sidewalk below; only a slab that something cuts, or that is no plain
//   ribbon, goes through polygon differences.
// Keeps: slab tops disjoint from car_clearance around every centre line.
#include "world/slabs.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"
#include "world/polygons.h"
#include "world/ribbon.h"
#include "world/surface_height.h"
#include "world/town.h"

namespace reprise::world {

namespace {

constexpr double storey = 2.5;         ///< [m] what lies farther above or below is another level
constexpr double bus_clearance = 1.6;  ///< [m] within junctions, where wide lanes fan out
constexpr double end_clearance =
    1.0;                            ///< [m] around a line's ends: paths may start with a sharp turn
constexpr double touch = 0.005;     ///< [m] neighbours that merely touch do not cut
constexpr double noticed = 0.002;   ///< [m2] smaller cuts are rounding
constexpr double kerb_depth = 0.3;  ///< [m] of the kerb faces below the road: no gap on slopes

/// Something that a slab must not cover.
struct Cutter {
    Loop loop;
    Box box;
    double z = 0;
};

struct Slab {
    std::vector<Loop> loops;
    std::vector<Box> boxes;  ///< of the loops, or of their parts: for looking up what is near
    Ribbon ribbon;           ///< sidewalks only
    SurfaceHeight height;    ///< of the road beside it
};

bool overlap(const Box& one, const Box& other) {
    return (one.low.array() < other.high.array()).all() &&
           (other.low.array() < one.high.array()).all();
}

double mean_height(const std::vector<Eigen::Vector3d>& corners) {
    double sum = 0;
    for (const Eigen::Vector3d& p : corners)
        sum += p.z();
    return sum / static_cast<double>(corners.size());
}

Loop flat_loop(const std::vector<Eigen::Vector3d>& corners) {
    Loop loop;
    for (const Eigen::Vector3d& p : corners)
        loop.push_back(p.head<2>());
    return loop;
}

void add_cutters(const Ribbon& ribbon, std::vector<Cutter>& cutters) {
    for (const auto& piece : ribbon.pieces) {
        const Loop loop = flat_loop(piece);
        cutters.push_back({loop, box_around(loop), mean_height(piece)});
    }
}

/// What a lane keeps clear of slabs.
void add_cutters(const LaneT& lane, std::vector<Cutter>& cutters) {
    if (lane.kind == LaneKind::crossing && lane.outline.size() >= 3) {
        const Loop loop = in_plan(lane.outline);
        cutters.push_back({loop, box_around(loop), lane.outline[0].z()});
    }
    if (!is_for_cars(lane))
        return;
    const double half_width = lane.kind == LaneKind::internal
                                  ? std::clamp(lane.width / 2, car_clearance, bus_clearance)
                                  : std::max(lane.width / 2, car_clearance) - touch;
    add_cutters(make_ribbon(clean_line(lane.centre), -half_width, half_width), cutters);
    // Where a path sets off sideways from its lane, neither's ribbon covers the corner between
    // them.
    add_cutters(make_ribbon(clean_line(lane.centre, end_clearance), -end_clearance, end_clearance),
                cutters);
}

Slab make_slab(const LaneT& lane) {
    Slab slab;
    if (lane.kind == LaneKind::walking_area) {
        slab.loops.push_back(in_plan(lane.outline));
        slab.boxes.push_back(box_around(slab.loops[0]));
        slab.height = SurfaceHeight({lane.outline});
        return slab;
    }
    slab.ribbon = make_ribbon(clean_line(lane.centre), -lane.width / 2, lane.width / 2);
    slab.loops = slab.ribbon.loops();
    for (const auto& piece : slab.ribbon.pieces)
        slab.boxes.push_back(box_around(flat_loop(piece)));
    slab.height = SurfaceHeight::along(clean_line(lane.centre));
    return slab;
}

/// All slabs of a town, and all that may cut them.
class Slabs {
  public:
    explicit Slabs(const TownT& town);

    void add_to(GroundBuilder& ground) const;

  private:
    std::vector<const Cutter*> cutters_of(const Slab& slab) const;
    bool is_hidden(std::size_t slab, const Eigen::Vector3d& p) const;
    void add_kerb(std::size_t slab, const Loop& border, GroundBuilder& ground) const;
    void add_slab(std::size_t slab, GroundBuilder& ground) const;

    Eigen::Vector2d origin_;
    std::vector<Slab> slabs_;
    std::vector<Cutter> cutters_;
    BoxGrid slabs_by_place_;
    BoxGrid cutters_by_place_;
};

Slabs::Slabs(const TownT& town) : origin_(std::floor(town.low.x()), std::floor(town.low.y())) {
    for (const LaneT& lane : town.lanes) {
        add_cutters(lane, cutters_);
        const bool is_area = lane.kind == LaneKind::walking_area && lane.outline.size() >= 3;
        if (lane.kind == LaneKind::sidewalk || is_area)
            slabs_.push_back(make_slab(lane));
    }
    std::vector<BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < cutters_.size(); ++i)
        entries.push_back({cutters_[i].box, i});
    cutters_by_place_ = BoxGrid(entries);
    entries.clear();
    for (std::uint32_t i = 0; i < slabs_.size(); ++i)
        for (const Box& box : slabs_[i].boxes)
            entries.push_back({box, i});
    slabs_by_place_ = BoxGrid(entries);
}

std::vector<const Cutter*> Slabs::cutters_of(const Slab& slab) const {
    std::vector<std::uint32_t> near;
    for (const Box& box : slab.boxes)
        for (const std::uint32_t index : cutters_by_place_.near(box))
            if (overlap(box, cutters_[index].box))
                near.push_back(index);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::vector<const Cutter*> found;
    for (const std::uint32_t index : near) {
        const Cutter& cutter = cutters_[index];
        const Eigen::Vector2d middle = (cutter.box.low + cutter.box.high) / 2;
        if (std::abs(slab.height.at(middle) - cutter.z) < storey)
            found.push_back(&cutter);
    }
    return found;
}

/// Is a place beside a slab covered by another one, so that no face shows there?
bool Slabs::is_hidden(std::size_t slab, const Eigen::Vector3d& p) const {
    const Eigen::Vector2d flat = p.head<2>();
    Box box;
    box.take(flat);
    const auto holds = [&](const Loop& loop) { return contains(loop, flat); };
    for (const std::uint32_t index : cutters_by_place_.near(box))
        if (std::abs(cutters_[index].z - p.z()) < storey && holds(cutters_[index].loop))
            return false;
    constexpr double level = 0.05;  // [m]
    for (const std::uint32_t index : slabs_by_place_.near(box)) {
        const Slab& other = slabs_[index];
        if (index != slab && std::any_of(other.loops.begin(), other.loops.end(), holds) &&
            std::abs(other.height.at(flat) - p.z()) < level)
            return true;
    }
    return false;
}

void Slabs::add_kerb(std::size_t slab, const Loop& border, GroundBuilder& ground) const {
    const SurfaceHeight& height = slabs_[slab].height;
    for (std::size_t i = 0; i < border.size(); ++i) {
        const Eigen::Vector2d start = border[i];
        const Eigen::Vector2d along = border[(i + 1) % border.size()] - start;
        const double length = along.norm();
        if (length < 1e-3)
            continue;
        // Short stretches: a face that is hidden for a part of its length is left out there only.
        const double stretch = height.is_plane() ? 8.0 : surface_cell;
        const int count = 1 + static_cast<int>(length / stretch);
        const Eigen::Vector2d outward = Eigen::Vector2d(along.y(), -along.x()) / length * 0.03;
        const auto at = [&](double share) {
            const Eigen::Vector2d p = start + share * along;
            return Eigen::Vector3d(p.x(), p.y(), height.at(p));
        };
        for (int k = 0; k < count; ++k) {
            const double first = static_cast<double>(k) / count;
            const double step = 1.0 / count;
            bool hidden = true;
            for (const double share : {0.02, 0.35, 0.65, 0.98}) {
                Eigen::Vector3d beside = at(first + share * step);
                beside.head<2>() += outward;
                hidden = hidden && is_hidden(slab, beside);
            }
            if (!hidden)
                ground.add_wall(
                    at(first), at(first + step), -kerb_depth, kerb_height, Surface::kerb);
        }
    }
}

void Slabs::add_slab(std::size_t index, GroundBuilder& ground) const {
    const Slab& slab = slabs_[index];
    Area area(origin_);
    for (const Loop& loop : slab.loops)
        area.add(loop);
    const std::vector<const Cutter*> cutters = cutters_of(slab);
    bool is_cut = false;
    if (!cutters.empty()) {
        Area clear(origin_);
        for (const Cutter* cutter : cutters)
            clear.add(cutter->loop);
        const double before = area.size();
        area.subtract(clear);
        is_cut = before - area.size() > noticed;
    }
    // The plain case keeps the ribbon's own quads.
    if (!is_cut && slab.ribbon.simple) {
        for (std::vector<Eigen::Vector3d> piece : slab.ribbon.pieces) {
            for (Eigen::Vector3d& corner : piece)
                corner.z() += kerb_height;
            ground.add_face(piece, Surface::sidewalk);
        }
        add_kerb(index, slab.loops[0], ground);
        return;
    }
    const auto top = [&](const Eigen::Vector2d& p) { return slab.height.at(p) + kerb_height; };
    const double cell = slab.height.is_plane() ? 0 : surface_cell;
    for (const Loop& piece : area.pieces())
        ground.add_face(piece, top, cell, Surface::sidewalk);
    for (const Loop& border : area.borders())
        add_kerb(index, border, ground);
}

void Slabs::add_to(GroundBuilder& ground) const {
    for (std::size_t i = 0; i < slabs_.size(); ++i)
        add_slab(i, ground);
}

}  // namespace

void add_slabs(const TownT& town, GroundBuilder& ground) {
    Slabs(town).add_to(ground);
}

}  // namespace reprise::world
