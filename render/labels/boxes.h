#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/labels/box_outline.h"
#include "render/trace/camera.h"
#include "world/tick.h"
#include "world/town_generated.h"

namespace reprise::render {

/// The box around an actor; of somebody on foot as he is at this tick, with limbs and luggage; of a
/// two-wheeler with its rider, leaning as it is seen.
struct ActorBox {
    Eigen::Isometry3d pose_world;  ///< of its middle; x ahead
    Eigen::Vector3d size;          ///< [m] along it, across, upwards
};

/// Nothing when it is not in the tick.
std::optional<ActorBox> actor_box(const world::TickView& tick, std::uint32_t actor);

/// A vehicle that a town has as it has benches: nobody ever drives it.
struct ParkedVehicle {
    std::uint32_t thing;  ///< see world::TownThings
    std::uint16_t model;  ///< index in world::vehicle_models()
    ActorBox box;
};

/// All that a town has, by their number.
std::vector<ParkedVehicle> parked_vehicles(const world::TownT& town);

/// An actor in a picture, or a parked vehicle.
struct LabelBox {
    std::uint32_t actor = 0;             ///< of a parked vehicle 0
    std::optional<std::uint32_t> thing;  ///< of a parked vehicle
    std::uint16_t instance = 0;
    world::SemanticClass what = world::SemanticClass::unlabeled;
    std::size_t pixels = 0;         ///< that show it
    PixelBox seen;                  ///< around these
    PixelBox whole;                 ///< around what the picture would show of its box in space
    Eigen::Vector3d size;           ///< [m] along it, across, upwards
    Eigen::Isometry3d pose_camera;  ///< of the middle of its box: to the camera's frame
};

/// Of all actors that at least one pixel shows, by their id, and of those of `parked` behind them.
/// `camera` in the world's frame; `instances` and `classes` are what it sees.
std::vector<LabelBox> boxes_of(const world::TickView& tick,
                               std::span<const ParkedVehicle> parked,
                               const Camera& camera,
                               const world::SensorFrame& instances,
                               const world::SensorFrame& classes);

}  // namespace reprise::render
