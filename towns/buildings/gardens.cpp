#include "towns/buildings/gardens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "towns/furnish/draws.h"
#include "towns/furnish/parked_cars.h"
#include "towns/furnish/plants.h"
#include "towns/furnish/props.h"
#include "world/models/building_models.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::Building;
using world::BuildingUse;
using world::PlantKind;
using world::PlotKind;
using world::PropKind;
using world::Purpose;

constexpr double side_strip = 1.5;    ///< [m] of garden beside a house
constexpr double back_garden = 6;     ///< [m] behind it
constexpr double fence_offset = 0.4;  ///< [m] of a fence behind the border of the road
constexpr double gateway = 1.6;       ///< [m] opening before the door
constexpr double driveway = 3;        ///< [m] wide
constexpr double deep_enough = 5.6;   ///< [m] of front garden for a car
constexpr double forecourt = 3.5;     ///< [m] before a building that is paved
constexpr double car_park_depth = 17;

/// One lot in the frame of its building: x along the street, front and street at -y.
class LotFrame {
  public:
    LotFrame(const Building& building, double setback)
        : building_(building),
          along_(std::cos(building.yaw()), std::sin(building.yaw())),
          front_(-building.width() / 2),
          border_(front_ - setback) {}

    Vector2d world(double x, double y) const {
        return world::in_plan(building_.centre()) + along_ * x +
               Vector2d(-along_.y(), along_.x()) * y;
    }

    Footprint rectangle(double x_low, double x_high, double y_low, double y_high) const {
        return {world((x_low + x_high) / 2, (y_low + y_high) / 2),
                building_.yaw(),
                x_high - x_low,
                y_high - y_low};
    }

    const Building& building() const { return building_; }

    double half() const { return building_.length() / 2; }

    double front() const { return front_; }

    double border() const { return border_; }  ///< y where the road begins

    double back() const { return building_.width() / 2; }

  private:
    const Building& building_;
    Vector2d along_;
    double front_;
    double border_;
};

class Gardener {
  public:
    explicit Gardener(PlacementContext& context) : context_(context) {}

    void lay_out_house(const LotFrame& lot, Draws& draws);
    void lay_out_shop(const LotFrame& lot, Draws& draws);
    void pave_front(const LotFrame& lot);

  private:
    bool add_plot(const Footprint& footprint, double z, PlotKind kind);
    void add_fence(const LotFrame& lot, double gap_from, double gap_to, Draws& draws);
    void add_fence_piece(const LotFrame& lot,
                         const Vector2d& from,
                         const Vector2d& to,
                         const PropCandidate& like);
    bool add_driveway(const LotFrame& lot, double side, Draws& draws);
    void add_plants(const LotFrame& lot, double driveway_side, Draws& draws);

    PlacementContext& context_;
};

/// Off all that is driven and walked on; else there is none.
bool Gardener::add_plot(const Footprint& footprint, double z, PlotKind kind) {
    if (!context_.roads.is_clear(footprint, 0.02) || !context_.walks.is_clear(footprint, 0.02) ||
        !context_.junctions.is_clear(footprint, 0.1) ||
        !context_.reserved.is_clear(footprint, 0.1) || context_.is_steep(footprint.centre))
        return false;
    world::PlotT plot;
    plot.kind = kind;
    for (const Vector2d& corner : corners(footprint))
        plot.outline.emplace_back(corner.x(), corner.y(), z);
    context_.town.plots.push_back(std::move(plot));
    return true;
}

void Gardener::add_fence_piece(const LotFrame& lot,
                               const Vector2d& from,
                               const Vector2d& to,
                               const PropCandidate& like) {
    const Vector2d start = lot.world(from.x(), from.y());
    const Vector2d along = lot.world(to.x(), to.y()) - start;
    if (along.norm() < 0.8)
        return;
    PropCandidate piece = like;
    piece.footprint = {start + along / 2,
                       std::atan2(along.y(), along.x()),
                       along.norm() - 0.3,  // so that pieces meet in a post's width
                       like.footprint.width};
    place_prop(context_, piece);
}

/// Along the street but for the opening, and back to the house on both sides.
void Gardener::add_fence(const LotFrame& lot, double gap_from, double gap_to, Draws& draws) {
    constexpr std::array<PropKind, 4> kinds{
        PropKind::fence, PropKind::hedge, PropKind::wall, PropKind::hedge};
    PropCandidate like;
    like.kind = kinds[draws.index(kinds.size())];
    like.height = like.kind == PropKind::hedge ? draws.between(0.8, 1.4) : draws.between(0.8, 1.1);
    like.footprint.width = like.kind == PropKind::hedge  ? 0.6
                           : like.kind == PropKind::wall ? 0.3
                                                         : 0.1;
    like.style = draws.style();
    like.road_z = lot.building().centre().z();
    like.from_solid = 0.02;
    like.from_walk = 0.05;
    // Low ones where drivers must see over them.
    if (!context_.sights.is_clear(lot.rectangle(-lot.half(), lot.half(), lot.border(), lot.front()),
                                  sight_distance))
        like.height = std::min(like.height, 0.95);
    const double y = lot.border() + fence_offset + like.footprint.width / 2;
    const double end = lot.half() + side_strip - 0.1;
    add_fence_piece(lot, {-end, y}, {gap_from, y}, like);
    add_fence_piece(lot, {gap_to, y}, {end, y}, like);
    add_fence_piece(lot, {-end, y + 0.5}, {-end, lot.front()}, like);
    add_fence_piece(lot, {end, y + 0.5}, {end, lot.front()}, like);
}

/// Gravel from the street to the house, with a car on it more often than not.
bool Gardener::add_driveway(const LotFrame& lot, double side, Draws& draws) {
    const double x = side * (lot.half() - driveway / 2);
    const double z = lot.building().centre().z();
    if (!add_plot(lot.rectangle(
                      x - driveway / 2, x + driveway / 2, lot.border() + 0.1, lot.front() - 0.05),
                  z,
                  PlotKind::gravel))
        return false;
    const Vector2d middle = lot.world(x, lot.front() - 0.5 - 2.35);
    const double yaw = lot.building().yaw() + (draws.chance(0.7) ? 0.5 : -0.5) * std::numbers::pi;
    if (draws.chance(0.65))
        park(context_, middle, yaw, z, draws);
    return true;
}

void Gardener::add_plants(const LotFrame& lot, double driveway_side, Draws& draws) {
    constexpr std::array<PlantKind, 3> bushes{
        PlantKind::round_bush, PlantKind::flowering_bush, PlantKind::tall_bush};
    const double z = lot.building().centre().z();
    const auto count = 2 + draws.index(4);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = draws.between(-lot.half(), lot.half());
        const PlantKind kind = bushes[draws.index(bushes.size())];
        const bool at_door = std::abs(x) < 1.2;
        const bool on_drive = driveway_side != 0 && x * driveway_side > lot.half() - driveway - 0.8;
        if (!at_door && !on_drive)
            place_bush(
                context_, kind, lot.world(x, lot.front() - draws.between(0.9, 1.4)), z, draws);
    }
    constexpr std::array<PlantKind, 4> trees{
        PlantKind::cherry, PlantKind::birch, PlantKind::maple, PlantKind::spruce};
    for (std::uint32_t i = 0; i < 2; ++i) {
        const PlantKind kind = trees[draws.index(trees.size())];
        const double x = draws.between(-lot.half(), lot.half());
        const double y = lot.back() + draws.between(3, back_garden);
        if (draws.chance(0.6))
            place_tree(context_, kind, lot.world(x, y), z, draws);
    }
}

void Gardener::lay_out_house(const LotFrame& lot, Draws& draws) {
    const double end = lot.half() + side_strip;
    const double z = lot.building().centre().z();
    // Less of it where the road bends into it, or another one passes behind.
    const double front = lot.border() + 0.1;
    for (const auto& [from, to] : {std::pair{front, lot.back() + back_garden},
                                   {front + 0.7, lot.back() + back_garden},
                                   {front, lot.front()},
                                   {front + 0.7, lot.front()},
                                   {front + 1.5, lot.front()}})
        if (add_plot(lot.rectangle(-end, end, from, to), z, PlotKind::lawn))
            break;
    const double side = draws.chance(0.5) ? 1 : -1;
    const bool has_drive = lot.front() - lot.border() > deep_enough && draws.chance(0.75) &&
                           add_driveway(lot, side, draws);
    const double gate = has_drive ? side * (lot.half() - driveway / 2) : draws.between(-1, 1);
    const double opening = has_drive ? driveway : gateway;
    if (draws.chance(0.8))
        add_fence(lot, gate - opening / 2, gate + opening / 2, draws);
    add_plants(lot, has_drive ? side : 0, draws);
}

/// Paving between the sidewalk and what stands right behind it.
void Gardener::pave_front(const LotFrame& lot) {
    add_plot(lot.rectangle(-lot.half(), lot.half(), lot.border() + 0.03, lot.front()),
             lot.building().centre().z(),
             PlotKind::square);
}

/// A car park behind a shop or an office, where there is room.
void Gardener::lay_out_shop(const LotFrame& lot, Draws& draws) {
    const double half = std::max(lot.half(), 9.0);
    const Footprint footprint =
        lot.rectangle(-half, half, lot.back() + 1, lot.back() + 1 + car_park_depth);
    const double z = lot.building().centre().z();
    if (!context_.solid.is_clear(footprint, 0.5) || !add_plot(footprint, z, PlotKind::car_park))
        return;
    context_.reserved.add_footprint(footprint);
    fill_car_park(context_, corners(footprint), z, draws);
}

}  // namespace

void lay_out_gardens(PlacementContext& context, std::span<const StreetBuilding> street_buildings) {
    constexpr std::size_t most = 1200;
    Gardener gardener(context);
    for (const StreetBuilding& built : street_buildings) {
        if (context.town.plots.size() > most)
            return;
        const Building building = context.town.buildings[built.building];
        const BuildingUse use = world::building_models()[building.model() - 1].use;
        Draws draws(context.seed, Purpose::plant, 1ULL << 32 | built.building);
        const LotFrame frame(building, built.setback);
        if (use != BuildingUse::house && built.setback < forecourt)
            gardener.pave_front(frame);
        if (use == BuildingUse::house && built.setback < 12)
            gardener.lay_out_house(frame, draws);
        else if ((use == BuildingUse::shop || use == BuildingUse::office) && draws.chance(0.5))
            gardener.lay_out_shop(frame, draws);
    }
}

}  // namespace reprise::towns
