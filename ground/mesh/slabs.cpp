// Must: raise sidewalks and walking areas by a kerb's height; keep every path of a car clear of
// them
//   (in real networks they lie on driving lanes by the dozen), and every crossing; close their
//   sides with kerb faces.
// Assumes: nothing of the outlines, which cross themselves or have no area in real networks.
// Goes: each slab on its own - what cuts it is looked up by place and by world::level_spacing, so
// that a bridge's
//   lanes do not cut the sidewalk below; only a slab that something cuts, or that is no plain
//   ribbon, goes through polygon differences. Splinters that are left over are dropped.
// Keeps: slab tops disjoint from car_clearance around every centre line.
#include "ground/mesh/slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ground/mesh/polygons.h"
#include "ground/mesh/ribbon.h"
#include "ground/mesh/slab_cutters.h"
#include "ground/mesh/splinters.h"
#include "ground/mesh/surface_height.h"
#include "world/frames.h"
#include "world/town.h"
#include "world/units.h"

namespace reprise::ground {

namespace {

constexpr double least_cut = 0.002;  ///< [m2] smaller cuts are rounding

struct Slab {
    std::vector<world::Loop> loops;
    std::vector<world::Loop> parts;  ///< the loops, or what they are put together from
    std::vector<world::Box> boxes;   ///< of each part: for looking up what is near
    Ribbon ribbon;                   ///< sidewalks only
    SurfaceHeight height;            ///< of the road beside it
    Area top;                        ///< what is left of it
    bool is_cut = false;
};

bool overlap(const world::Box& one, const world::Box& other) {
    return (one.low.array() < other.high.array()).all() &&
           (other.low.array() < one.high.array()).all();
}

/// Does a line along one of its sides keep all of a loop from all of the other, with room for the
/// rounding of both?
bool is_apart_along(const world::Loop& loop, const world::Loop& other) {
    constexpr double room = 0.005;  // [m]
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d along = loop[(i + 1) % loop.size()] - loop[i];
        const Eigen::Vector2d across = Eigen::Vector2d(along.y(), -along.x()).normalized();
        const auto reach = [&](const world::Loop& of, double sign) {
            double most = -std::numeric_limits<double>::infinity();
            for (const Eigen::Vector2d& p : of)
                most = std::max(most, sign * across.dot(p));
            return most;
        };
        if (reach(loop, 1) + room < -reach(other, -1) || reach(other, 1) + room < -reach(loop, -1))
            return true;
    }
    return false;
}

Slab make_slab(const world::LaneT& lane) {
    Slab slab;
    if (lane.kind == world::LaneKind::walking_area) {
        slab.loops.push_back(world::in_plan(lane.outline));
        slab.parts = slab.loops;
        slab.height = SurfaceHeight({lane.outline});
        return slab;
    }
    slab.ribbon = make_ribbon(clean_line(lane.centre), -lane.width / 2, lane.width / 2);
    slab.loops = slab.ribbon.loops();
    for (const auto& piece : slab.ribbon.pieces)
        slab.parts.push_back(world::in_plan(piece));
    slab.height = SurfaceHeight::along(clean_line(lane.centre));
    return slab;
}

/// All slabs of a town, and all that may cut them.
class Slabs {
  public:
    explicit Slabs(const world::TownT& town);

    void add_to(GroundBuilder& ground) const;

  private:
    std::vector<const SlabCutter*> cutters_near(const world::Box& box,
                                                const SurfaceHeight& height) const;
    void cut(Slab& slab) const;
    bool is_at_crossing(const world::Loop& outline, const SurfaceHeight& height) const;
    void drop_splinters();
    bool is_hidden(std::size_t slab, const Eigen::Vector3d& p) const;
    void add_kerb(std::size_t slab, const world::Loop& border, GroundBuilder& ground) const;
    void add_slab(std::size_t slab, GroundBuilder& ground) const;

    Eigen::Vector2d origin_;
    std::vector<Slab> slabs_;
    std::vector<SlabCutter> cutters_;
    world::BoxGrid slabs_by_place_;
    world::BoxGrid cutters_by_place_;
};

Slabs::Slabs(const world::TownT& town)
    : origin_(std::floor(town.low.x()), std::floor(town.low.y())),
      cutters_(slab_cutters(town)) {
    for (const world::LaneT& lane : town.lanes) {
        const bool is_area = lane.kind == world::LaneKind::walking_area && lane.outline.size() >= 3;
        if (lane.kind == world::LaneKind::sidewalk || is_area)
            slabs_.push_back(make_slab(lane));
    }
    for (Slab& slab : slabs_)
        for (const world::Loop& part : slab.parts)
            slab.boxes.push_back(world::box_around(part));
    std::vector<world::BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < cutters_.size(); ++i)
        entries.push_back({cutters_[i].box, i});
    cutters_by_place_ = world::BoxGrid(entries);
    entries.clear();
    for (std::uint32_t i = 0; i < slabs_.size(); ++i)
        for (const world::Box& box : slabs_[i].boxes)
            entries.push_back({box, i});
    slabs_by_place_ = world::BoxGrid(entries);
    for (Slab& slab : slabs_)
        cut(slab);
    drop_splinters();
}

/// Those of the same level whose box overlaps, in their order.
std::vector<const SlabCutter*> Slabs::cutters_near(const world::Box& box,
                                                   const SurfaceHeight& height) const {
    std::vector<const SlabCutter*> found;
    for (const std::uint32_t index : cutters_by_place_.near(box)) {
        const SlabCutter& cutter = cutters_[index];
        const Eigen::Vector2d middle = (cutter.box.low + cutter.box.high) / 2;
        if (overlap(box, cutter.box) &&
            std::abs(height.at(middle) - cutter.z) < world::level_spacing)
            found.push_back(&cutter);
    }
    return found;
}

void Slabs::cut(Slab& slab) const {
    slab.top = Area(origin_);
    for (const world::Loop& loop : slab.loops)
        slab.top.add(loop);
    std::vector<const SlabCutter*> cutters;
    for (std::size_t i = 0; i < slab.boxes.size(); ++i)
        for (const SlabCutter* cutter : cutters_near(slab.boxes[i], slab.height))
            // Many boxes overlap of what is far apart, and each cutter costs.
            if (!is_apart_along(slab.parts[i], cutter->loop) &&
                !is_apart_along(cutter->loop, slab.parts[i]))
                cutters.push_back(cutter);
    if (cutters.empty())
        return;
    // All of them are elements of one vector.
    std::sort(cutters.begin(), cutters.end());
    cutters.erase(std::unique(cutters.begin(), cutters.end()), cutters.end());
    Area clear(origin_);
    for (const SlabCutter* cutter : cutters)
        clear.add(cutter->loop);
    const double before = slab.top.size();
    slab.top.subtract(clear);
    slab.is_cut = before - slab.top.size() > least_cut;
}

bool Slabs::is_at_crossing(const world::Loop& outline, const SurfaceHeight& height) const {
    const std::vector<const SlabCutter*> near =
        cutters_near(world::box_around(outline, joined_within), height);
    return std::any_of(near.begin(), near.end(), [&](const SlabCutter* cutter) {
        return cutter->is_crossing && distance_between(outline, cutter->loop) <= joined_within;
    });
}

/// What cars leave over between their paths becomes road, or whatever lies under it.
void Slabs::drop_splinters() {
    std::vector<Area> parts;
    std::vector<std::size_t> slab_of_part;
    for (std::size_t i = 0; i < slabs_.size(); ++i)
        for (Area& part : slabs_[i].top.parts()) {
            parts.push_back(std::move(part));
            slab_of_part.push_back(i);
        }
    std::vector<Patch> patches;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::vector<world::Loop> borders = parts[i].borders();
        const SurfaceHeight& height = slabs_[slab_of_part[i]].height;
        patches.push_back({&parts[i],
                           &height,
                           borders,
                           world::box_around(borders[0]),
                           is_at_crossing(borders[0], height)});
    }
    const std::vector<bool> is_splinter = find_splinters(patches);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (is_splinter[i]) {
            slabs_[slab_of_part[i]].top.subtract(parts[i]);
            slabs_[slab_of_part[i]].is_cut = true;
        }
}

/// Is a place beside a slab covered by another one, so that no face shows there?
bool Slabs::is_hidden(std::size_t slab, const Eigen::Vector3d& p) const {
    const Eigen::Vector2d flat = p.head<2>();
    world::Box box;
    box.take(flat);
    const auto holds = [&](const world::Loop& loop) { return world::contains(loop, flat); };
    for (const std::uint32_t index : cutters_by_place_.near(box))
        if (std::abs(cutters_[index].z - p.z()) < world::level_spacing &&
            holds(cutters_[index].loop))
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

void Slabs::add_kerb(std::size_t slab, const world::Loop& border, GroundBuilder& ground) const {
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
    // The plain case keeps the ribbon's own quads.
    if (!slab.is_cut && slab.ribbon.simple) {
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
    for (const world::Loop& piece : slab.top.pieces())
        ground.add_face(piece, top, cell, Surface::sidewalk);
    for (const world::Loop& border : slab.top.borders())
        add_kerb(index, border, ground);
}

void Slabs::add_to(GroundBuilder& ground) const {
    for (std::size_t i = 0; i < slabs_.size(); ++i)
        add_slab(i, ground);
}

}  // namespace

void add_slabs(const world::TownT& town, GroundBuilder& ground) {
    Slabs(town).add_to(ground);
}

}  // namespace reprise::ground
