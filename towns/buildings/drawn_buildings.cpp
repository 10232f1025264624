#include "towns/buildings/drawn_buildings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "towns/buildings/building_choice.h"
#include "towns/buildings/floors.h"
#include "towns/buildings/rectangular_site.h"
#include "towns/furnish/draws.h"
#include "world/models/building_models.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::Purpose;

constexpr double overlap_allowed = 0.5;  ///< [m] a drawn building may reach into a lane
constexpr double smallest_drawn = 2;     ///< [m2]

/// Each has some thousand triangles: in a city the rest stay prisms.
constexpr std::size_t most_models = 1500;

/// The lanes for cars, as buildings have to leave them free.
class FreeLanes {
  public:
    explicit FreeLanes(const world::TownT& town) {
        std::vector<world::BoxGrid::Entry> entries;
        for (const world::LaneT& lane : town.lanes) {
            if (!world::is_for_cars(lane))
                continue;
            strips_.add_line(lane.centre, std::max(0.1, lane.width / 2 - overlap_allowed));
            const Vector2d start = world::in_plan(lane.centre.front());
            entries.push_back({{start, start}, static_cast<std::uint32_t>(starts_.size())});
            starts_.push_back(start);
        }
        grid_ = world::BoxGrid(entries);
    }

    /// Does no wall reach into a lane by more than is allowed, and lies none inside?
    bool are_clear_of(const world::Loop& loop) const {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vector2d along = loop[(i + 1) % loop.size()] - loop[i];
            const double yaw = std::atan2(along.y(), along.x());
            if (!strips_.is_clear({loop[i] + along / 2, yaw, along.norm(), 0}, 0))
                return false;
        }
        const std::vector<std::uint32_t> near = grid_.near(world::box_around(loop));
        return std::none_of(near.begin(), near.end(), [&](std::uint32_t lane) {
            return world::contains(loop, starts_[lane]);
        });
    }

  private:
    Clearance strips_{1};
    std::vector<Vector2d> starts_;
    world::BoxGrid grid_;
};

/// A whole building of its model, with roof, door and chimneys, where the footprint allows. False:
/// it stays as drawn.
bool stand_as_model(PlacementContext& context,
                    const world::DrawnBuildingT& drawn,
                    const Streets& streets) {
    if (context.town.buildings.size() >= most_models)
        return false;
    const world::BuildingModel& model = world::building_models()[drawn.model - 1];
    const auto site = rectangular_site(world::in_plan(drawn.outline), streets);
    const auto f = site ? fit(model, *site, streets) : std::nullopt;
    // Its rectangle reaches over corners that the outline leaves to the buses.
    constexpr double margin = 0.15;  // [m]
    if (!f || !context.roads.is_clear(*f, margin))
        return false;
    context.solid.add_footprint(*f);
    // The model's door may be on another side than the one that the outline's floor was set for.
    const double z = drawn.outline.front().z();
    context.town.buildings.emplace_back(
        world::Vec3(
            f->centre.x(), f->centre.y(), floor_on(context.ground_heights, *f, z).value_or(z)),
        f->yaw,
        f->length,
        f->width,
        drawn.height,
        drawn.style,
        drawn.model);
    return true;
}

}  // namespace

void keep_drawn_buildings(PlacementContext& context) {
    const FreeLanes lanes(context.town);
    const Districts districts(context);
    const Streets streets(context.town);
    for (std::size_t i = 0; i < context.place.buildings.size(); ++i) {
        world::DrawnBuildingT drawn = context.place.buildings[i];
        const double area = world::signed_area(world::in_plan(drawn.outline));
        if (std::abs(area) < smallest_drawn)
            continue;
        if (area < 0)
            std::reverse(drawn.outline.begin(), drawn.outline.end());
        const world::Loop loop = world::in_plan(drawn.outline);
        if (!lanes.are_clear_of(loop))
            continue;
        set_floor(context, drawn);
        Draws draws(context.seed, Purpose::building_model, 1U << 24 | i);
        if (drawn.style == 0)
            drawn.style = draws.style();
        if (drawn.model == 0)
            drawn.model =
                1 + choose_model(districts.at(loop[0]), StreetSetting::street, draws.between(0, 1));
        context.solid.add_polygon(loop);
        if (!stand_as_model(context, drawn, streets))
            context.town.drawn_buildings.push_back(std::move(drawn));
        context.buildings.add_polygon(loop);
    }
}

}  // namespace reprise::towns
