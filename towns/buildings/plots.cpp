#include "towns/buildings/plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "towns/furnish/draws.h"
#include "towns/furnish/parked_cars.h"
#include "towns/furnish/plants.h"
#include "towns/furnish/props.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::Loop;
using world::PlantKind;
using world::PlotKind;
using world::PlotT;
using world::PropKind;
using world::Purpose;

constexpr double smallest_plot = 4;  ///< [m2]

/// One plot with all that is put on it.
class Layout {
  public:
    /// `over`: plots that lie over this one.
    Layout(PlacementContext& context, const PlotT& plot, std::span<const PlotT> over, Draws& draws)
        : context_(context),
          loop_(world::in_plan(plot.outline)),
          draws_(draws) {
        for (const PlotT& other : over)
            over_.add_polygon(other.outline);
        for (const Vector2d& p : loop_)
            middle_ += p / static_cast<double>(loop_.size());
        for (const world::Vec3& p : plot.outline)
            z_ += p.z() / static_cast<double>(plot.outline.size());
        box_ = world::box_around(loop_);
    }

    void park();
    void square();
    void playground();
    void forest();

    void car_park() { fill_car_park(context_, loop_, z_, draws_); }

    void lawn() { scatter_trees(16, 0.5, lawn_kinds); }

  private:
    static constexpr std::array<PlantKind, 4> park_kinds{
        PlantKind::plane, PlantKind::lime, PlantKind::maple, PlantKind::birch};
    static constexpr std::array<PlantKind, 4> forest_kinds{
        PlantKind::spruce, PlantKind::pine, PlantKind::birch, PlantKind::spruce};
    static constexpr std::array<PlantKind, 4> lawn_kinds{
        PlantKind::birch, PlantKind::cherry, PlantKind::maple, PlantKind::cherry};

    bool is_inside(const Vector2d& p, double margin) const;
    bool add(
        PropKind kind, const Vector2d& p, double yaw, double length, double width, double height);
    void scatter_trees(double spacing, double share, const std::array<PlantKind, 4>& kinds);
    void scatter_bushes(int count);
    void add_along_border(double inwards, double spacing);
    void add_around(PropKind kind, double radius, int count);

    PlacementContext& context_;
    Loop loop_;
    Clearance over_{4};
    Draws& draws_;
    Vector2d middle_ = Vector2d::Zero();
    double z_ = 0;
    world::Box box_;
};

/// As far from the border as that, tried at eight points around; and off what lies over it.
bool Layout::is_inside(const Vector2d& p, double margin) const {
    if (!over_.is_clear(p, margin))
        return false;
    for (int i = 0; i < 8; ++i) {
        const double angle = std::atan(1.0) * i;
        if (!world::contains(loop_, p + Vector2d(std::cos(angle), std::sin(angle)) * margin))
            return false;
    }
    return true;
}

bool Layout::add(
    PropKind kind, const Vector2d& p, double yaw, double length, double width, double height) {
    if (!is_inside(p, 0.5 * std::hypot(length, width)))
        return false;
    PropCandidate candidate;
    candidate.kind = kind;
    candidate.footprint = {p, yaw, length, width};
    candidate.height = height;
    candidate.road_z = z_;
    candidate.from_solid = 0.6;
    candidate.from_walk = 0.3;
    candidate.style = draws_.style();
    return place_prop(context_, candidate);
}

/// On a grid, each moved a little.
void Layout::scatter_trees(double spacing, double share, const std::array<PlantKind, 4>& kinds) {
    for (double x = box_.low.x() + 2; x < box_.high.x(); x += spacing)
        for (double y = box_.low.y() + 2; y < box_.high.y(); y += spacing) {
            const double off_x = draws_.between(-0.4, 0.4) * spacing;
            const double off_y = draws_.between(-0.4, 0.4) * spacing;
            const Vector2d p(x + off_x, y + off_y);
            const PlantKind kind = kinds[draws_.index(kinds.size())];
            if (draws_.chance(share) && is_inside(p, 1.5))
                place_tree(context_, kind, p, z_, draws_);
        }
}

void Layout::scatter_bushes(int count) {
    constexpr std::array<PlantKind, 3> kinds{
        PlantKind::round_bush, PlantKind::flowering_bush, PlantKind::tall_bush};
    for (int i = 0; i < count; ++i) {
        const double x = draws_.between(box_.low.x(), box_.high.x());
        const double y = draws_.between(box_.low.y(), box_.high.y());
        const Vector2d p(x, y);
        const PlantKind kind = kinds[draws_.index(kinds.size())];
        if (is_inside(p, 1.5))
            place_bush(context_, kind, p, z_, draws_);
    }
}

/// Benches that look inwards, each second one with a bin beside it.
void Layout::add_along_border(double inwards, double spacing) {
    for (std::size_t i = 0; i < loop_.size(); ++i) {
        const Vector2d along = loop_[(i + 1) % loop_.size()] - loop_[i];
        const double length = along.norm();
        if (length < 8)
            continue;
        const Vector2d x = along / length;
        const Vector2d in(-x.y(), x.x());
        bool bin = false;
        for (double s = 5; s < length - 4; s += spacing, bin = !bin) {
            const Vector2d p = loop_[i] + x * s + in * inwards;
            add(PropKind::bench, p, std::atan2(x.y(), x.x()), 1.8, 0.6, 0.85);
            if (bin)
                add(PropKind::bin, p + x * 2, 0, 0.5, 0.5, 0.9);
        }
    }
}

void Layout::add_around(PropKind kind, double radius, int count) {
    for (int i = 0; i < count; ++i) {
        const double angle = 8 * std::atan(1.0) * i / count;
        const Vector2d out(std::cos(angle), std::sin(angle));
        add(kind, middle_ + out * radius, angle + 2 * std::atan(1.0), 1.8, 0.6, 0.85);
    }
}

void Layout::park() {
    add(PropKind::table, middle_ + Vector2d(6, 3), 0.4, 1.8, 1.6, 0.8);
    add_along_border(3, 16);
    scatter_trees(9, 0.55, park_kinds);
    const double area = std::abs(world::signed_area(loop_));
    scatter_bushes(static_cast<int>(std::min(area / 120, 40.0)));
}

void Layout::square() {
    const double area = std::abs(world::signed_area(loop_));
    if (area > 300 && add(PropKind::fountain, middle_, 0, 5, 5, 2.2))
        add_around(PropKind::bench, 5.5, 6);
    add_along_border(2.5, 12);
    scatter_trees(11, 0.35, park_kinds);
}

void Layout::playground() {
    add(PropKind::swing, middle_, draws_.between(0, 3), 3.6, 2, 2.4);
    add(PropKind::swing, middle_ + Vector2d(0, 6), draws_.between(0, 3), 3.6, 2, 2.4);
    add(PropKind::table, middle_ + Vector2d(-6, 0), 0, 1.8, 1.6, 0.8);
    add_along_border(1.5, 9);
    scatter_trees(12, 0.3, lawn_kinds);
}

void Layout::forest() {
    // A large forest is thinner, so that it is filled from end to end.
    const double area = std::abs(world::signed_area(loop_));
    scatter_trees(std::max(4.5, std::sqrt(area / 700)), 0.85, forest_kinds);
    scatter_bushes(static_cast<int>(std::min(area / 60, 60.0)));
}

void fill(Layout& layout, PlotKind kind) {
    switch (kind) {
        case PlotKind::park:
            return layout.park();
        case PlotKind::square:
            return layout.square();
        case PlotKind::playground:
            return layout.playground();
        case PlotKind::forest:
            return layout.forest();
        case PlotKind::car_park:
            return layout.car_park();
        case PlotKind::lawn:
            return layout.lawn();
        default:
            return;
    }
}

}  // namespace

void lay_out_plots(PlacementContext& context) {
    for (std::size_t i = 0; i < context.place.plots.size(); ++i) {
        PlotT plot = context.place.plots[i];
        const double area = world::signed_area(world::in_plan(plot.outline));
        if (std::abs(area) < smallest_plot)
            continue;
        if (area < 0)
            std::reverse(plot.outline.begin(), plot.outline.end());
        Draws draws(context.seed, Purpose::furniture, 1ULL << 32 | i);
        Layout layout(context, plot, std::span(context.place.plots).subspan(i + 1), draws);
        fill(layout, plot.kind);
        context.town.plots.push_back(std::move(plot));
    }
}

}  // namespace reprise::towns
