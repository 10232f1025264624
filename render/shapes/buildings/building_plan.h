#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "render/shapes/fast_math.h"
#include "world/models/building_models.h"
#include "world/town_generated.h"

namespace reprise::render {

/// How a wall is divided and used; decides where openings are.
enum class WallUse : std::uint8_t {
    front,   ///< to the street: doors, shop windows or gates on the ground floor
    back,    ///< windows and one door
    side,    ///< some windows
    blank,   ///< none
    window,  ///< one column of windows, as on bays and dormers
    belfry,  ///< one tall opening with slats
    sign,    ///< a board with the shop's name
    clock    ///< a clock's face fills it
};

/// A flat, upright face of a building, for painting windows and doors on it at the hit.
struct Wall {
    Eigen::Vector3f foot;   ///< lower left corner for who looks at it; scene
    Eigen::Vector3f along;  ///< unit vector to the right
    float length;
    float height;
    float ground_floor;  ///< height of the ground floor above `foot`; 0: none
    float floor_height;  ///< of those above
    int floors;          ///< above the ground floor
    int columns;         ///< of windows
    WallUse use;
    std::uint32_t building;  ///< index in Facades.buildings
    std::uint32_t seed;
};

/// Colours that go together, and what else a building's faces have in common.
struct BuildingPaint {
    BuildingPaint(const world::BuildingModel& of, std::uint32_t seed_of_it);

    const world::BuildingModel* model;
    std::uint32_t seed;
    Color wall;
    Color trim;   ///< sills, ledges, columns
    Color frame;  ///< of windows
    Color door;
    Color roof;          ///< tiles or slates
    Color accent;        ///< awnings, signs, shutters, gates
    bool arched;         ///< windows with round heads
    bool shutters;       ///< beside the windows
    bool half_timbered;  ///< beams on pale infill
    int door_every;      ///< columns from one front door to the next; 0: one door

    bool has(world::BuildingPart part) const { return (model->parts & part) != 0; }
};

/// What the faces of a town's buildings look like, beside their triangles.
struct Facades {
    std::vector<Wall> walls;               ///< Material::wall is tagged with an index into these
    std::vector<BuildingPaint> buildings;  ///< see BuildingFinish
};

/// What a part of a building is made of. Material::building is tagged with
/// building_finishes * (index in Facades.buildings) + this.
enum class BuildingFinish : std::uint8_t {
    masonry,  ///< as the walls
    trim,
    tiles,
    deck,     ///< bitumen and gravel on flat roofs
    metal,    ///< dark: railings, frames
    machine,  ///< pale sheet metal
    copper,
    glass,
    awning,
    timber
};

inline constexpr std::uint32_t building_finishes = 16;

/// A building's numbers; mesh and looks agree through them. Frame: x along the street, front at -y,
/// origin in the middle of the footprint, on the ground. [m]
struct BuildingPlan {
    BuildingPlan(const world::BuildingModel& model,
                 double length,
                 double width,
                 double height,
                 std::uint32_t style);

    /// That of a building of the town; for one without a model by its style.
    static const world::BuildingModel& model_of(std::uint32_t model,
                                                double height,
                                                std::uint32_t style);

    const world::BuildingModel& model;
    std::uint32_t seed;
    float x;      ///< half of the length
    float y;      ///< half of the width
    float eaves;  ///< height of the walls
    float ground_floor;
    float floor_height;
    int floors;  ///< above the ground floor
    float rise;  ///< of the roof above the eaves; 0 when flat

    bool has(world::BuildingPart part) const { return (model.parts & part) != 0; }

    int columns(float wall) const;  ///< of windows on a wall of this length

    float floor(int level) const {  ///< height of a floor, 0 is the ground floor
        return level == 0 ? 0 : ground_floor + floor_height * static_cast<float>(level - 1);
    }
};

/// Has this column of the front balconies?
bool has_balcony(const world::BuildingModel& model, int column, int columns);

}  // namespace reprise::render
