#include "towns/import/mapped_building.h"

#include <algorithm>
#include <optional>

#include "ground/mesh/roofs.h"
#include "world/geometry2d.h"

namespace reprise::towns {

namespace {

using world::BuildingModel;
using world::RoofKind;

constexpr double lowest_eaves = 2.3;   ///< [m]
constexpr double lowest_share = 0.35;  ///< of the whole: no house is all roof

bool is_high_enough(double eaves, double ridge) {
    return eaves >= std::max(lowest_eaves, lowest_share * ridge);
}

/// [m] with the highest of its roof at `ridge`; none: its roof is too high for that.
std::optional<double> eaves_below(double ridge,
                                  const BuildingModel& model,
                                  const Footprint& f,
                                  std::uint32_t style) {
    const auto x = static_cast<float>(f.length / 2);
    const auto y = static_cast<float>(f.width / 2);
    const double nave =
        ridge - static_cast<double>(ground::roof_rise(model, x, y, ground::building_seed(style)));
    if (model.roof == RoofKind::spire) {
        const double tower = nave - static_cast<double>(ground::spire_rise(model, y));
        if (is_high_enough(tower, nave))
            return tower;
        // The map knows the nave only: the tower stands over it.
    }
    return is_high_enough(nave, ridge) ? std::optional(nave) : std::nullopt;
}

/// What stands on an outline that no model fits: see render/shapes/buildings/drawn_building.cpp.
double eaves_of_prism(double ridge, const BuildingModel& model, const world::Loop& outline) {
    const bool pitched = model.roof == RoofKind::gabled || model.roof == RoofKind::hipped;
    const double eaves = ridge - (pitched ? ground::hipped_rise(outline) : 0);
    return std::max(eaves, std::min(ridge, lowest_eaves));
}

}  // namespace

world::DrawnBuildingT mapped_building(const Tags& tags,
                                      const std::vector<world::Vec3>& outline,
                                      const Streets& streets,
                                      std::uint64_t draw) {
    const auto models = world::building_models();
    const world::Loop loop = world::in_plan(outline);
    const std::optional<double> ridge = ridge_height(tags);
    const std::optional<RectangularSite> site = rectangular_site(loop, streets);
    world::DrawnBuildingT building;
    building.outline = outline;
    building.style = std::max(1U, static_cast<std::uint32_t>(draw >> 48));
    for (const std::vector<std::uint32_t>& choice : suitable_models(tags))
        for (std::size_t i = 0; site && i < choice.size(); ++i) {
            const std::uint32_t index = choice[(draw + i) % choice.size()];
            const std::optional<Footprint> f = fit(models[index], *site, streets);
            const auto eaves = !f      ? std::nullopt
                               : ridge ? eaves_below(*ridge, models[index], *f, building.style)
                                       : std::optional(eaves_height(tags));
            if (!eaves)
                continue;
            building.model = 1 + index;
            building.height = *eaves;
            return building;
        }
    building.model = model_of(tags, draw);
    building.height =
        ridge ? eaves_of_prism(*ridge, models[building.model - 1], loop) : eaves_height(tags);
    return building;
}

}  // namespace reprise::towns
