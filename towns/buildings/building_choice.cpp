#include "towns/buildings/building_choice.h"

#include <array>
#include <cmath>
#include <span>

#include "world/check.h"
#include "world/models/building_models.h"
#include "world/random.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;

constexpr double region_size = 160;    ///< [m]
constexpr double centre_radius = 110;  ///< [m] around the greatest junction
constexpr std::array<std::string_view, 5> style_names{
    "village", "old", "brick", "modern", "centre"};

/// A model, and how many of a hundred or so it is.
struct Choice {
    const char* model;
    int weight;
};

// clang-format off
constexpr Choice village_quiet[] = {{"cottage", 6}, {"brick_house", 4}, {"hipped_house", 5}, {"timber_house", 4}, {"bungalow", 4}, {"farmhouse", 3}, {"villa", 2}};
constexpr Choice village_street[] = {{"cottage", 4}, {"brick_house", 4}, {"hipped_house", 4}, {"farmhouse", 3}, {"timber_house", 3}, {"corner_shop", 2}, {"restaurant", 2}, {"timber_terrace", 2}};
constexpr Choice village_behind[] = {{"farmhouse", 4}, {"cottage", 4}, {"bungalow", 3}, {"garage", 1}};
constexpr Choice old_quiet[] = {{"plaster_terrace", 4}, {"timber_terrace", 3}, {"old_town_row", 3}, {"villa", 2}, {"stone_terrace", 2}};
constexpr Choice old_street[] = {{"old_town_row", 6}, {"stone_terrace", 4}, {"plaster_terrace", 3}, {"arcade_shops", 2}, {"corner_shop", 2}, {"mansard_flats", 3}, {"restaurant", 1}};
constexpr Choice old_behind[] = {{"mansard_flats", 3}, {"courtyard_flats", 3}, {"chapel", 1}, {"plaster_flats", 2}};
constexpr Choice brick_quiet[] = {{"brick_house", 5}, {"brick_terrace", 5}, {"bungalow", 3}, {"hipped_house", 1}};
constexpr Choice brick_street[] = {{"brick_terrace", 5}, {"brick_flats", 3}, {"fire_escape_flats", 3}, {"brick_office", 2}, {"corner_shop", 2}, {"shop_row", 1}};
constexpr Choice brick_behind[] = {{"brick_flats", 3}, {"courtyard_flats", 3}, {"brick_office", 2}, {"garage", 2}};
constexpr Choice modern_quiet[] = {{"modern_house", 6}, {"modern_terrace", 4}, {"bungalow", 2}, {"plaster_flats", 1}};
constexpr Choice modern_street[] = {{"modern_terrace", 3}, {"plaster_flats", 4}, {"ribbon_office", 3}, {"shop_row", 2}, {"supermarket", 1}, {"slab_flats", 2}};
constexpr Choice modern_behind[] = {{"slab_flats", 4}, {"flats_tower", 2}, {"plaster_flats", 3}, {"garage", 1}};
constexpr Choice centre_quiet[] = {{"mansard_flats", 3}, {"stone_office", 2}, {"old_town_row", 3}, {"fire_escape_flats", 2}};
constexpr Choice centre_street[] = {{"stone_office", 3}, {"glass_office", 3}, {"ribbon_office", 2}, {"department_store", 1}, {"mansard_flats", 3}, {"arcade_shops", 2}, {"office_tower", 1}};
constexpr Choice centre_behind[] = {{"glass_tower", 3}, {"office_tower", 3}, {"flats_tower", 2}, {"glass_office", 2}};

// clang-format on

std::span<const Choice> choices(BuildingStyle style, StreetSetting street_setting) {
    const std::array<std::array<std::span<const Choice>, 3>, 5> all{{
        {village_quiet, village_street, village_behind},
        {old_quiet, old_street, old_behind},
        {brick_quiet, brick_street, brick_behind},
        {modern_quiet, modern_street, modern_behind},
        {centre_quiet, centre_street, centre_behind},
    }};
    return all[static_cast<std::size_t>(style)][static_cast<std::size_t>(street_setting)];
}

/// Where the most driving lanes come together; ties to the first by name.
Vector2d greatest_junction(const world::TownT& town) {
    std::vector<int> lanes(town.junctions.size(), 0);
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving && lane.junction != world::none)
            ++lanes[lane.junction];
    std::size_t best = 0;
    for (std::size_t i = 1; i < lanes.size(); ++i)
        if (lanes[i] > lanes[best])
            best = i;
    return lanes.empty() ? Vector2d(0, 0) : world::in_plan(town.junctions[best].centre);
}

Vector2d mean_of(const std::vector<world::Vec3>& outline) {
    Vector2d sum(0, 0);
    for (const world::Vec3& p : outline)
        sum += world::in_plan(p);
    return sum / static_cast<double>(outline.size());
}

}  // namespace

std::optional<BuildingStyle> find_building_style(std::string_view name) {
    for (std::size_t i = 0; i < style_names.size(); ++i)
        if (name == style_names[i])
            return static_cast<BuildingStyle>(i);
    return std::nullopt;
}

Districts::Districts(const PlacementContext& context)
    : seed_(context.seed),
      middle_(greatest_junction(context.town)) {
    for (auto plot = context.place.plots.rbegin(); plot != context.place.plots.rend(); ++plot)
        if (plot->kind == world::PlotKind::square && !plot->outline.empty())
            middle_ = mean_of(plot->outline);
    for (const Place::District& district : context.place.districts)
        if (const auto style = find_building_style(district.style))
            regions_.push_back({*style, world::in_plan(district.outline)});
}

BuildingStyle Districts::at(const Vector2d& p) const {
    std::optional<BuildingStyle> everywhere;
    for (auto region = regions_.rbegin(); region != regions_.rend(); ++region) {
        if (region->loop.empty())
            everywhere = region->style;
        else if (world::contains(region->loop, p))
            return region->style;
    }
    if (everywhere)
        return *everywhere;
    if ((p - middle_).norm() < centre_radius)
        return BuildingStyle::centre;
    const auto column = static_cast<std::int32_t>(std::floor(p.x() / region_size));
    const auto row = static_cast<std::int32_t>(std::floor(p.y() / region_size));
    return static_cast<BuildingStyle>(world::draw_index(4,
                                                        seed_,
                                                        static_cast<std::uint32_t>(column),
                                                        world::Purpose::building_model,
                                                        static_cast<std::uint32_t>(row)));
}

std::uint32_t choose_model(BuildingStyle style, StreetSetting street_setting, double drawn) {
    const std::span<const Choice> from = choices(style, street_setting);
    int sum = 0;
    for (const Choice& choice : from)
        sum += choice.weight;
    double left = drawn * sum;
    for (const Choice& choice : from) {
        left -= choice.weight;
        if (left < 0) {
            const auto model = world::find_building_model(choice.model);
            REPRISE_CHECK(model.has_value(), choice.model);
            return *model;
        }
    }
    return *world::find_building_model(from.back().model);
}

}  // namespace reprise::towns
