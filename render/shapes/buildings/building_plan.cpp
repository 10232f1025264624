#include "render/shapes/buildings/building_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ground/mesh/roofs.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using world::BuildingUse;
using world::FacadeKind;
using world::RoofKind;

/// A wall and what suits it.
struct Scheme {
    Color wall;
    Color trim;
    Color frame;
};

const Color white(.68F, .67F, .63F);
const Color cream(.62F, .56F, .44F);
const Color pale_stone(.55F, .52F, .46F);
const Color anthracite(.045F, .048F, .052F);
const Color bronze(.10F, .075F, .05F);

std::span<const Scheme> schemes(FacadeKind facade) {
    static const std::array<Scheme, 6> brick{{{{.30F, .115F, .075F}, pale_stone, white},
                                              {{.36F, .165F, .095F}, white, white},
                                              {{.22F, .095F, .075F}, pale_stone, anthracite},
                                              {{.42F, .305F, .195F}, pale_stone, white},
                                              {{.27F, .135F, .10F}, cream, bronze},
                                              {{.40F, .37F, .33F}, white, anthracite}}};
    static const std::array<Scheme, 9> plaster{{{{.68F, .62F, .49F}, white, white},
                                                {{.70F, .69F, .65F}, pale_stone, anthracite},
                                                {{.63F, .47F, .31F}, white, white},
                                                {{.50F, .56F, .56F}, white, white},
                                                {{.69F, .57F, .43F}, white, bronze},
                                                {{.57F, .37F, .30F}, cream, white},
                                                {{.62F, .63F, .51F}, white, white},
                                                {{.46F, .52F, .60F}, white, white},
                                                {{.68F, .55F, .29F}, white, bronze}}};
    static const std::array<Scheme, 5> stone{{{{.50F, .46F, .38F}, {.60F, .56F, .48F}, white},
                                              {{.44F, .43F, .41F}, {.56F, .55F, .52F}, white},
                                              {{.57F, .52F, .43F}, {.63F, .59F, .51F}, bronze},
                                              {{.38F, .36F, .34F}, pale_stone, anthracite},
                                              {{.52F, .43F, .33F}, {.60F, .54F, .44F}, white}}};
    static const std::array<Scheme, 5> office{
        {{{.42F, .43F, .44F}, white, anthracite},
         {{.58F, .57F, .54F}, white, anthracite},
         {{.29F, .31F, .34F}, {.45F, .46F, .47F}, anthracite},
         {{.52F, .46F, .38F}, white, bronze},
         {{.60F, .61F, .62F}, {.35F, .37F, .40F}, anthracite}}};
    static const std::array<Scheme, 3> glass{
        {{{.16F, .17F, .18F}, {.30F, .31F, .32F}, anthracite},
         {{.10F, .12F, .13F}, {.24F, .27F, .28F}, anthracite},
         {{.34F, .35F, .36F}, {.50F, .51F, .52F}, anthracite}}};
    static const std::array<Scheme, 7> timber{{{{.66F, .65F, .61F}, white, white},
                                               {{.30F, .065F, .045F}, white, white},
                                               {{.34F, .40F, .34F}, white, white},
                                               {{.30F, .37F, .43F}, white, white},
                                               {{.62F, .53F, .33F}, white, white},
                                               {{.24F, .155F, .09F}, cream, anthracite},
                                               {{.16F, .17F, .18F}, white, white}}};
    static const std::array<Scheme, 4> metal{{{{.52F, .53F, .54F}, {.32F, .34F, .36F}, anthracite},
                                              {{.62F, .62F, .60F}, {.40F, .41F, .42F}, anthracite},
                                              {{.28F, .34F, .39F}, white, anthracite},
                                              {{.40F, .42F, .36F}, white, anthracite}}};
    switch (facade) {
        case FacadeKind::brick:
            return brick;
        case FacadeKind::plaster:
            return plaster;
        case FacadeKind::stone:
            return stone;
        case FacadeKind::office:
            return office;
        case FacadeKind::glass:
            return glass;
        case FacadeKind::timber:
            return timber;
        case FacadeKind::metal:
            return metal;
    }
    return plaster;
}

}  // namespace

BuildingPaint::BuildingPaint(const world::BuildingModel& of, std::uint32_t seed_of_it)
    : model(&of),
      seed(seed_of_it) {
    static const std::array<Color, 6> tiles{Color(.35F, .115F, .058F),
                                            Color(.26F, .095F, .062F),
                                            Color(.115F, .118F, .128F),
                                            Color(.29F, .145F, .082F),
                                            Color(.17F, .145F, .125F),
                                            Color(.085F, .092F, .105F)};
    static const std::array<Color, 7> doors{Color(.17F, .075F, .036F),
                                            Color(.045F, .11F, .075F),
                                            Color(.055F, .08F, .17F),
                                            Color(.25F, .035F, .03F),
                                            Color(.06F, .06F, .065F),
                                            Color(.30F, .31F, .30F),
                                            Color(.10F, .17F, .19F)};
    static const std::array<Color, 8> accents{Color(.33F, .045F, .04F),
                                              Color(.05F, .15F, .095F),
                                              Color(.05F, .10F, .25F),
                                              Color(.38F, .24F, .05F),
                                              Color(.10F, .105F, .115F),
                                              Color(.27F, .07F, .12F),
                                              Color(.06F, .20F, .24F),
                                              Color(.45F, .16F, .04F)};
    const std::span<const Scheme> kinds = schemes(of.facade);
    const Scheme& scheme = kinds[hash(seed, 1) % kinds.size()];
    // A little of its own: no two walls were painted in the same year.
    const float age = mix(0.90F, 1.06F, unit(hash(seed, 2)));
    wall = scheme.wall * age;
    trim = scheme.trim;
    frame = scheme.frame;
    door = doors[hash(seed, 3) % doors.size()];
    accent = accents[hash(seed, 5) % accents.size()];
    // Slates on stone and offices, tiles on the rest.
    const bool slated = of.facade == FacadeKind::stone || of.roof == RoofKind::mansard;
    const std::array<std::size_t, 3> slates{2, 4, 5};
    roof = slated ? tiles[slates[hash(seed, 4) % 3]] : tiles[hash(seed, 4) % tiles.size()];
    if (of.facade == FacadeKind::metal)
        roof = Color(.30F, .31F, .32F);
    arched = of.roof == RoofKind::spire ||
             (of.use == BuildingUse::shop && has(world::part_arcade)) ||
             (of.use == BuildingUse::civic && of.facade == FacadeKind::stone);
    const bool homely = of.use == BuildingUse::house || of.use == BuildingUse::terrace;
    shutters = homely && of.roof != RoofKind::flat && of.roof != RoofKind::shed &&
               of.facade != FacadeKind::brick && hash(seed, 6) % 2 == 0;
    half_timbered = of.facade == FacadeKind::timber && hash(seed, 7) % 3 == 0;
    if (half_timbered)
        trim = Color(.085F, .055F, .035F);
    door_every = of.use == BuildingUse::terrace && !has(world::part_shop_front) ? 2 : 0;
}

BuildingPlan::BuildingPlan(
    const world::BuildingModel& of, double length, double width, double height, std::uint32_t style)
    : model(of),
      seed(ground::building_seed(style)),
      x(static_cast<float>(length / 2)),
      y(static_cast<float>(width / 2)),
      eaves(static_cast<float>(height)),
      ground_floor(std::min(static_cast<float>(of.ground_floor), eaves)) {
    // A parapet or the roof's beams are over the last floor.
    const bool flat = of.roof == RoofKind::flat || of.roof == RoofKind::dome;
    const float above = eaves - ground_floor - (flat ? 0.6F : 0.15F);
    const auto wish = static_cast<float>(of.floor_height);
    floors = std::max(0, static_cast<int>(above / wish + 0.35F));
    if (of.most_floors == 1)
        floors = 0;
    floor_height = floors == 0 ? wish : above / static_cast<float>(floors);
    if (floors == 0)
        ground_floor = eaves - (flat ? 0.6F : 0.15F);
    rise = ground::roof_rise(of, x, y, seed);
}

const world::BuildingModel& BuildingPlan::model_of(std::uint32_t model,
                                                   double height,
                                                   std::uint32_t style) {
    const auto models = world::building_models();
    if (model >= 1 && model <= models.size())
        return models[model - 1];
    static const std::array<std::string_view, 5> low{
        "bungalow", "modern_house", "corner_shop", "shop_row", "garage"};
    static const std::array<std::string_view, 5> middle{
        "brick_flats", "modern_house", "plaster_flats", "stone_office", "ribbon_office"};
    static const std::array<std::string_view, 4> high{
        "slab_flats", "glass_office", "office_tower", "flats_tower"};
    const std::uint32_t draw = hash(style, 0x30de1u);
    const std::string_view name = height < 5    ? low[draw % low.size()]
                                  : height < 19 ? middle[draw % middle.size()]
                                                : high[draw % high.size()];
    return models[world::find_building_model(name).value_or(0)];
}

int BuildingPlan::columns(float wall) const {
    return std::max(1, static_cast<int>(wall / static_cast<float>(model.bay) + 0.3F));
}

bool has_balcony(const world::BuildingModel& model, int column, int columns) {
    if ((model.parts & world::part_balconies) == 0)
        return false;
    // Slabs have one for every flat, others in columns with plain ones between.
    if (model.most_floors >= 8)
        return column % 2 == 0;
    return column % 3 == (columns > 3 ? 1 : 0) && column + 1 < columns;
}

}  // namespace reprise::render
