#include "world/models/building_models.h"

#include <array>

namespace reprise::world {

namespace {

using enum BuildingUse;
using Facade = FacadeKind;
using Roof = RoofKind;

// clang-format off
constexpr std::array<BuildingModel, 40> buildings{{
    // name               use      facade           roof           length     depth     floors  heights    bay   parts
    {"cottage",           house,   Facade::plaster, Roof::gabled,   9,  12,   8,  10,   1,  2,  2.8, 2.6,  2.8, part_porch | part_chimney},
    {"brick_house",       house,   Facade::brick,   Roof::gabled,  10,  14,   9,  12,   2,  2,  2.9, 2.7,  2.8, part_porch | part_chimney},
    {"hipped_house",      house,   Facade::plaster, Roof::hipped,  11,  15,  10,  13,   2,  2,  2.9, 2.7,  3.0, part_porch | part_dormers},
    {"timber_house",      house,   Facade::timber,  Roof::gabled,   9,  13,   8,  11,   2,  2,  2.8, 2.6,  2.6, part_porch | part_chimney},
    {"villa",             house,   Facade::stone,   Roof::hipped,  14,  18,  12,  15,   2,  3,  3.4, 3.1,  3.2, part_bays | part_porch | part_chimney},
    {"bungalow",          house,   Facade::brick,   Roof::hipped,  12,  16,   9,  12,   1,  1,  2.9, 2.7,  3.0, part_porch},
    {"modern_house",      house,   Facade::plaster, Roof::flat,    10,  15,   9,  13,   2,  3,  3.0, 2.9,  3.6, part_balconies},
    {"farmhouse",         house,   Facade::stone,   Roof::gabled,  14,  20,   8,  10,   2,  2,  2.8, 2.6,  3.0, part_chimney | part_dormers},
    {"brick_terrace",     terrace, Facade::brick,   Roof::gabled,  18,  30,   9,  11,   2,  3,  3.0, 2.8,  2.5, part_chimney | part_bays},
    {"plaster_terrace",   terrace, Facade::plaster, Roof::gabled,  18,  30,   9,  12,   2,  3,  3.0, 2.8,  2.6, part_dormers | part_porch},
    {"stone_terrace",     terrace, Facade::stone,   Roof::mansard, 18,  32,  10,  12,   3,  4,  3.4, 3.0,  2.6, part_bays | part_chimney},
    {"timber_terrace",    terrace, Facade::timber,  Roof::gabled,  16,  26,   9,  11,   2,  3,  2.9, 2.6,  2.4, part_porch},
    {"modern_terrace",    terrace, Facade::plaster, Roof::shed,    18,  30,  10,  12,   2,  3,  2.9, 2.8,  3.2, part_balconies},
    {"old_town_row",      terrace, Facade::plaster, Roof::gabled,  15,  24,  10,  13,   3,  4,  3.6, 3.0,  2.4, part_shop_front | part_dormers},
    {"brick_flats",       flats,   Facade::brick,   Roof::flat,    16,  28,  12,  15,   4,  6,  3.0, 2.8,  3.0, part_balconies | part_roof_plant},
    {"plaster_flats",     flats,   Facade::plaster, Roof::hipped,  16,  26,  12,  14,   3,  5,  3.0, 2.8,  2.9, part_balconies},
    {"mansard_flats",     flats,   Facade::stone,   Roof::mansard, 18,  30,  12,  15,   4,  6,  3.8, 3.1,  2.7, part_shop_front | part_balconies | part_dormers},
    {"fire_escape_flats", flats,   Facade::brick,   Roof::flat,    15,  24,  13,  16,   4,  6,  3.6, 3.0,  2.6, part_fire_escape | part_shop_front},
    {"slab_flats",        flats,   Facade::office,  Roof::flat,    28,  45,  11,  13,   6,  9,  3.2, 2.8,  3.2, part_balconies | part_roof_plant},
    {"courtyard_flats",   flats,   Facade::brick,   Roof::hipped,  24,  36,  12,  15,   3,  4,  3.2, 2.9,  2.8, part_arcade | part_dormers},
    {"corner_shop",       shop,    Facade::brick,   Roof::gabled,  10,  15,   9,  12,   2,  3,  3.6, 2.8,  2.7, part_shop_front | part_awning | part_chimney},
    {"shop_row",          shop,    Facade::plaster, Roof::flat,    18,  30,  10,  14,   1,  2,  4.0, 3.0,  3.2, part_shop_front | part_awning},
    {"arcade_shops",      shop,    Facade::stone,   Roof::mansard, 18,  30,  12,  15,   3,  4,  4.2, 3.2,  3.0, part_shop_front | part_arcade},
    {"supermarket",       shop,    Facade::metal,   Roof::flat,    26,  40,  18,  26,   1,  1,  5.0, 3.5,  5.0, part_shop_front | part_roof_plant},
    {"restaurant",        shop,    Facade::timber,  Roof::hipped,  11,  16,   9,  13,   1,  2,  3.6, 2.9,  2.8, part_shop_front | part_awning | part_porch},
    {"market_hall",       shop,    Facade::brick,   Roof::gabled,  22,  34,  14,  20,   1,  1,  6.0, 3.5,  4.0, part_arcade},
    {"department_store",  shop,    Facade::stone,   Roof::flat,    26,  40,  18,  26,   3,  5,  4.6, 3.8,  3.6, part_shop_front | part_awning | part_roof_plant},
    {"stone_office",      office,  Facade::stone,   Roof::flat,    18,  30,  13,  18,   4,  6,  4.4, 3.4,  2.8, part_roof_plant},
    {"ribbon_office",     office,  Facade::office,  Roof::flat,    20,  36,  14,  18,   3,  6,  3.8, 3.4,  3.2, part_roof_plant},
    {"glass_office",      office,  Facade::glass,   Roof::flat,    20,  32,  15,  20,   4,  8,  4.5, 3.6,  2.4, part_roof_plant},
    {"brick_office",      office,  Facade::brick,   Roof::sawtooth,20,  34,  14,  18,   2,  4,  4.2, 3.6,  3.6, part_chimney},
    {"glass_tower",       tower,   Facade::glass,   Roof::flat,    20,  28,  20,  26,  11, 16,  5.0, 3.6,  2.4, part_roof_plant},
    {"office_tower",      tower,   Facade::office,  Roof::flat,    20,  28,  18,  24,  10, 14,  4.6, 3.4,  3.0, part_roof_plant},
    {"flats_tower",       tower,   Facade::plaster, Roof::flat,    18,  24,  18,  22,   9, 14,  3.4, 2.9,  3.2, part_balconies | part_roof_plant},
    {"church",            civic,   Facade::stone,   Roof::spire,   22,  30,  11,  14,   1,  1,  9.0, 4.0,  4.0, part_clock},
    {"chapel",            civic,   Facade::brick,   Roof::spire,   14,  18,   8,  10,   1,  1,  6.0, 3.5,  3.4, part_porch},
    {"town_hall",         civic,   Facade::stone,   Roof::dome,    24,  34,  14,  18,   2,  3,  4.8, 4.2,  3.4, part_arcade | part_clock},
    {"school",            civic,   Facade::brick,   Roof::hipped,  26,  40,  12,  16,   2,  3,  3.8, 3.5,  3.2, part_clock},
    {"fire_station",      garage,  Facade::brick,   Roof::flat,    18,  26,  13,  17,   2,  2,  4.6, 3.2,  4.2, part_gate},
    {"garage",            garage,  Facade::metal,   Roof::shed,    12,  20,  10,  14,   1,  1,  4.2, 3.0,  4.4, part_gate},
}};
// clang-format on

}  // namespace

std::span<const BuildingModel> building_models() {
    return buildings;
}

std::optional<std::uint32_t> find_building_model(std::string_view name) {
    for (std::uint32_t i = 0; i < buildings.size(); ++i)
        if (name == buildings[i].name)
            return i;
    return std::nullopt;
}

}  // namespace reprise::world
