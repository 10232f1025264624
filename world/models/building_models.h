#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace reprise::world {

/// Walls reach that far below the ground floor: on a slope they are seen, and hit. [m]
inline constexpr double foundation_depth = 8;

/// What a building is for: decides where in a town it stands.
enum class BuildingUse : std::uint8_t { house, terrace, flats, shop, office, tower, civic, garage };

/// What the faces are made of.
enum class FacadeKind : std::uint8_t { brick, plaster, stone, office, glass, timber, metal };

enum class RoofKind : std::uint8_t { flat, gabled, hipped, mansard, shed, sawtooth, spire, dome };

/// What is built onto the walls. Bits.
enum BuildingPart : std::uint16_t {
    part_balconies = 1,
    part_bays = 2,        ///< bay windows over the height
    part_porch = 4,       ///< a roof over the door
    part_shop_front = 8,  ///< glass ground floor with a sign over it
    part_awning = 16,     ///< over the shop front
    part_chimney = 32,
    part_dormers = 64,
    part_roof_plant = 128,  ///< machines on a flat roof
    part_arcade = 256,      ///< columns before the ground floor
    part_gate = 512,        ///< garage doors
    part_fire_escape = 1024,
    part_clock = 2048  ///< a tower with a clock or a bell
};

/// A parametric building: what is drawn by seed within these bounds. Frame: x along the street, the
/// front at -y. [m]
struct BuildingModel {
    const char* name;
    BuildingUse use;
    FacadeKind facade;
    RoofKind roof;
    double shortest, longest;    ///< along the street
    double shallowest, deepest;  ///< away from it
    int fewest_floors, most_floors;
    double ground_floor;  ///< height of the ground floor
    double floor_height;  ///< of those above
    double bay;           ///< wanted distance between the middles of two windows
    std::uint16_t parts;
};

/// The 40 models. Building.model is 1 + an index into it: append only.
std::span<const BuildingModel> building_models();

/// Index in building_models().
std::optional<std::uint32_t> find_building_model(std::string_view name);

}  // namespace reprise::world
