#pragma once

#include <array>
#include <optional>

#include "towns/furnish/clearance.h"
#include "world/models/building_models.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// Where a town's streets and sidewalks are, for buildings that a map draws.
struct Streets {
    explicit Streets(const world::TownT& town);

    Clearance roads{60};  ///< lanes for cars [m]
    Clearance walks{2};   ///< sidewalks [m]
};

/// A footprint that is nearly a rectangle, seen from each of its sides: with that side as the front
/// (at -y, as models have it).
struct RectangularSite {
    std::array<Footprint, 4> fronts;
    std::array<double, 4> to_street;  ///< [m] from the middle of the front
};

/// The rectangle around an outline, shrunk to the outline's area, so that neighbours stay apart.
/// None when the outline fills less than 92 % of it, or it would stand on a street.
std::optional<RectangularSite> rectangular_site(const world::Loop& outline, const Streets& streets);

/// How a model stands on it: with its door to the nearest street that its sizes allow. Porches and
/// bays stay off the sidewalk: the front steps back where they would reach onto it. None: the site
/// is far smaller or larger than what the model is made for.
std::optional<Footprint> fit(const world::BuildingModel& model,
                             const RectangularSite& site,
                             const Streets& streets);

}  // namespace reprise::towns
