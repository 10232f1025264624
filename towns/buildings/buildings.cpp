// What it must do: build up both sides of the roads of any network, so that it looks like a town;
//   the same one for the same network and name.
// What it assumes: roadsides are polylines.
// How it goes: a few landmarks first, each at the best of some drawn sites; then along every
//   roadside house by house; then rows behind, where blocks are deep. A footprint is built when it
//   is clear of everything; a small one is tried where a large one has no room.
// What it keeps: buildings in rows and those that stand alone, because only rows may touch.
#include "towns/buildings/buildings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "towns/buildings/building_choice.h"
#include "towns/buildings/floors.h"
#include "towns/furnish/draws.h"
#include "world/check.h"
#include "world/models/building_models.h"

namespace reprise::towns {

namespace {

using world::BuildingModel;
using world::BuildingUse;
using world::Purpose;
using world::Vec3;

constexpr double most_buildings = 3000;
constexpr double party_wall = 0.03;     ///< [m] between buildings of a row: they must not overlap
constexpr double detached_gap = 3;      ///< [m] between all others
constexpr double behind_gap = 7;        ///< [m] around those of rows behind
constexpr double country_share = 0.12;  ///< of the sites along country roads
constexpr double verge = 2.5;           ///< [m] more where there is no sidewalk
constexpr double quiet_speed = 9;       ///< [m/s]

bool is_in_row(const BuildingModel& model) {
    return model.use == BuildingUse::terrace || model.use == BuildingUse::shop ||
           (model.use == BuildingUse::flats && model.longest <= 30) ||
           (model.use == BuildingUse::office && model.facade == world::FacadeKind::stone);
}

/// A building that could be built.
struct Draft {
    std::uint32_t model = 0;
    Footprint footprint;
    double z = 0;
    double setback = 0;
};

class Builder {
  public:
    explicit Builder(PlacementContext& context) : context_(context), districts_(context) {}

    void add_landmarks();
    void add_rows();
    void add_rows_behind();

    std::vector<StreetBuilding> take_street_buildings() { return std::move(street_buildings_); }

  private:
    Draft draft(
        const Roadside& roadside, double s, std::uint32_t model, Draws& draws, bool small) const;
    bool is_clear(const Draft& draft, double gap) const;
    void build(std::uint32_t roadside, const Draft& draft, Draws& draws);
    std::optional<Draft> find(const Roadside& roadside, double s, Draws& draws) const;
    std::optional<Draft> find_behind(const Roadside& roadside,
                                     double s,
                                     double away,
                                     Draws& draws) const;
    void add_landmark(const char* model, double from_middle, std::uint64_t item);
    StreetSetting street_setting(const Roadside& roadside) const;
    double share(double spacing) const;

    PlacementContext& context_;
    Districts districts_;
    Clearance rows_{1};
    Clearance detached_{8};
    std::vector<StreetBuilding> street_buildings_;
};

double setback_of(const BuildingModel& model, Draws& draws) {
    switch (model.use) {
        case BuildingUse::house:
            return draws.between(4, 7);
        case BuildingUse::terrace:
        case BuildingUse::shop:
            // Steps and bays need room of their own before the sidewalk.
            return (model.parts & (world::part_porch | world::part_bays)) != 0
                       ? draws.between(1.4, 2.4)
                       : draws.between(0.5, 1.2);
        case BuildingUse::flats:
            return is_in_row(model) ? draws.between(0.8, 3.4) : draws.between(3, 6);
        case BuildingUse::office:
        case BuildingUse::tower:
            return draws.between(1, 4);
        default:
            return draws.between(5, 9);
    }
}

/// The building with its near corner at s. [m]
Draft Builder::draft(
    const Roadside& roadside, double s, std::uint32_t model, Draws& draws, bool small) const {
    const BuildingModel& m = world::building_models()[model];
    Draft found;
    found.model = model;
    const double length = draws.between(m.shortest, m.longest);
    const double width = draws.between(m.shallowest, m.deepest);
    found.footprint.length = small ? m.shortest : length;
    found.footprint.width = small ? m.shallowest : width;
    found.setback = setback_of(m, draws) + (roadside.walk > 0 ? 0 : verge);
    const RoadsidePose at = roadside_pose(
        roadside, s + found.footprint.length / 2, found.setback + found.footprint.width / 2);
    found.footprint.centre = at.position;
    found.footprint.yaw = facing_yaw(roadside, at);
    // On a slope the lower end decides: no door hangs in the air.
    found.z = std::min(roadside_pose(roadside, s, 0).z,
                       roadside_pose(roadside, s + found.footprint.length, 0).z);
    return found;
}

bool Builder::is_clear(const Draft& draft, double gap) const {
    const Footprint& f = draft.footprint;
    const double front = std::max(0.4, 0.8 * draft.setback - 0.1);
    const bool in_row = is_in_row(world::building_models()[draft.model]) && gap <= detached_gap;
    return context_.walks.is_clear(f, std::min(front, 4.0)) && context_.roads.is_clear(f, 1.5) &&
           context_.junctions.is_clear(f, 0.5) && context_.reserved.is_clear(f, 0.5) &&
           detached_.is_clear(f, gap) && rows_.is_clear(f, 0) &&
           (in_row ? rows_.is_clear(f, party_wall / 2) : context_.buildings.is_clear(f, gap)) &&
           context_.solid.is_clear(f, party_wall / 2) &&
           context_.sights.is_clear(f, sight_distance) && !context_.is_steep(f.centre) &&
           floor_on(context_.ground_heights, f, draft.z).has_value();
}

void Builder::build(std::uint32_t roadside, const Draft& draft, Draws& draws) {
    const BuildingModel& m = world::building_models()[draft.model];
    const Footprint& f = draft.footprint;
    const int floors = m.fewest_floors + static_cast<int>(draws.index(static_cast<std::size_t>(
                                             m.most_floors - m.fewest_floors + 1)));
    const double eaves = m.ground_floor + m.floor_height * (floors - 1);
    street_buildings_.push_back(
        {static_cast<std::uint32_t>(context_.town.buildings.size()), roadside, draft.setback});
    const double floor = floor_on(context_.ground_heights, f, draft.z).value_or(draft.z);
    context_.town.buildings.emplace_back(Vec3(f.centre.x(), f.centre.y(), floor),
                                         f.yaw,
                                         f.length,
                                         f.width,
                                         eaves,
                                         draws.style(),
                                         draft.model + 1);
    (is_in_row(m) ? rows_ : detached_).add_footprint(f);
    context_.buildings.add_footprint(f);
    context_.solid.add_footprint(f);
}

StreetSetting Builder::street_setting(const Roadside& roadside) const {
    if (roadside.driven == world::none || context_.is_rural(roadside))
        return StreetSetting::quiet_street;
    const world::LaneT& lane = context_.town.lanes[roadside.driven];
    const bool single = lane.left == world::none && lane.right == world::none;
    return single && lane.speed_limit < quiet_speed ? StreetSetting::quiet_street
                                                    : StreetSetting::street;
}

/// Share of the sites to use, so that a large network ends near the cap instead of filling its
/// first roads only.
double Builder::share(double spacing) const {
    double length = 0;
    for (const Roadside& roadside : context_.roadsides)
        length += roadside.border.length;
    return std::min(1.0, most_buildings * spacing / std::max(length, 1.0));
}

void Builder::add_landmark(const char* name, double from_middle, std::uint64_t item) {
    const auto model = world::find_building_model(name);
    REPRISE_CHECK(model.has_value(), name);
    constexpr int sites = 120;
    Draws draws(context_.seed, Purpose::building_model, item);
    std::optional<Draft> best;
    std::uint32_t best_roadside = 0;
    double least = 1e9;
    for (int i = 0; i < sites; ++i) {
        const std::uint32_t index = draws.index(context_.roadsides.size());
        const Roadside& roadside = context_.roadsides[index];
        const double s = draws.between(0, roadside.border.length);
        const Draft found = draft(roadside, s, *model, draws, false);
        const double off =
            std::abs((found.footprint.centre - districts_.middle()).norm() - from_middle);
        if (off >= least || s + found.footprint.length > roadside.border.length ||
            !is_clear(found, detached_gap))
            continue;
        best = found;
        best_roadside = index;
        least = off;
    }
    if (best)
        build(best_roadside, *best, draws);
}

void Builder::add_landmarks() {
    constexpr double smallest_town = 1500;  ///< [m] of roadsides
    double length = 0;
    for (const Roadside& roadside : context_.roadsides)
        length += roadside.border.length;
    if (length < smallest_town)
        return;

    struct Landmark {
        const char* model;
        double from_middle;
    };

    constexpr std::array<Landmark, 5> landmarks{{{"town_hall", 40},
                                                 {"church", 90},
                                                 {"market_hall", 70},
                                                 {"fire_station", 160},
                                                 {"school", 200}}};
    for (std::size_t i = 0; i < landmarks.size(); ++i)
        add_landmark(landmarks[i].model, landmarks[i].from_middle, i);
}

/// A building with its near corner at s: a large one, the same model or another at its smallest, or
/// a small one of the quiet kind.
std::optional<Draft> Builder::find(const Roadside& roadside, double s, Draws& draws) const {
    const BuildingStyle style = context_.is_rural(roadside)
                                    ? BuildingStyle::village
                                    : districts_.at(roadside_pose(roadside, s, 8).position);
    const std::uint32_t wanted = choose_model(style, street_setting(roadside), draws.between(0, 1));
    const std::uint32_t other = choose_model(style, street_setting(roadside), draws.between(0, 1));
    const std::uint32_t modest =
        choose_model(style, StreetSetting::quiet_street, draws.between(0, 1));
    const std::array<std::pair<std::uint32_t, bool>, 4> tries{
        {{wanted, false}, {wanted, true}, {other, true}, {modest, true}}};
    for (const auto& [model, small] : tries) {
        const Draft found = draft(roadside, s, model, draws, small);
        if (s + found.footprint.length <= roadside.border.length + 2 &&
            is_clear(found, detached_gap))
            return found;
    }
    return std::nullopt;
}

void Builder::add_rows() {
    const double kept = share(18);
    for (std::uint32_t i = 0; i < context_.roadsides.size(); ++i) {
        const Roadside& roadside = context_.roadsides[i];
        Draws draws(context_.seed, Purpose::building, i);
        const bool country = context_.is_rural(roadside);
        double s = draws.between(0, 2);
        while (s < roadside.border.length - 6) {
            if (!draws.chance(country ? country_share * kept : kept)) {
                s += 18;
                continue;
            }
            const std::optional<Draft> found = find(roadside, s, draws);
            if (!found) {
                s += 2;
                continue;
            }
            build(i, *found, draws);
            const bool in_row = is_in_row(world::building_models()[found->model]);
            // Now and then a passage leads through a row.
            s += found->footprint.length +
                 (in_row && draws.chance(0.8) ? party_wall : draws.between(3.1, 7));
        }
    }
}

std::optional<Draft> Builder::find_behind(const Roadside& roadside,
                                          double s,
                                          double away,
                                          Draws& draws) const {
    const BuildingStyle style = districts_.at(roadside_pose(roadside, s, away).position);
    const std::uint32_t model = choose_model(style, StreetSetting::second_row, draws.between(0, 1));
    Draft found = draft(roadside, s, model, draws, draws.chance(0.4));
    const RoadsidePose at =
        roadside_pose(roadside, s + found.footprint.length / 2, away + found.footprint.width / 2);
    found.footprint.centre = at.position;
    found.setback = away;
    if (s + found.footprint.length > roadside.border.length + 10 || !is_clear(found, behind_gap))
        return std::nullopt;
    return found;
}

void Builder::add_rows_behind() {
    const double kept = share(40);
    for (std::uint32_t i = 0; i < context_.roadsides.size(); ++i) {
        const Roadside& roadside = context_.roadsides[i];
        if (roadside.driven == world::none || context_.is_rural(roadside))
            continue;
        Draws draws(context_.seed, Purpose::building, 1U << 24 | i);
        for (const double row : {24.0, 44.0})
            for (double s = draws.between(0, 10); s < roadside.border.length - 10;) {
                const double away = row + draws.between(0, 6);
                const std::optional<Draft> found =
                    draws.chance(kept * 0.8) ? find_behind(roadside, s, away, draws) : std::nullopt;
                if (found)
                    build(i, *found, draws);
                s += found ? found->footprint.length + draws.between(7, 14) : 8;
            }
    }
}

}  // namespace

std::vector<StreetBuilding> place_buildings(PlacementContext& context) {
    if (!context.place.buildings.empty() || context.roadsides.empty())
        return {};
    Builder builder(context);
    builder.add_landmarks();
    builder.add_rows();
    builder.add_rows_behind();
    return builder.take_street_buildings();
}

}  // namespace reprise::towns
