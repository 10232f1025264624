#pragma once

#include <span>
#include <vector>

#include "render/shapes/cars/two_wheeler.h"
#include "render/shapes/limb.h"
#include "render/shapes/mesh.h"
#include "render/shapes/people/wardrobe.h"
#include "world/models/catalogue.h"
#include "world/traffic_generated.h"

namespace reprise::render {

/// Bits of a walker's look; of one that was not recorded (an imported run), from his id.
std::uint32_t look_of(const world::WalkerState& walker);

/// The limbs of a walker at his phase of the walk (see posture.h) with what he carries. Frame: x
/// ahead, on the ground between his feet. One who was hit lies on his back.
std::vector<Limb> figure(const world::WalkerModel& model,
                         const world::WalkerState& walker,
                         bool rains);

/// A rider in the frame of his upright two-wheeler. `steering` of its front wheel [rad]; `crank`
/// [rad], 0: left pedal down. `outfit` as drawn by the look of the vehicle.
std::vector<Limb> rider(const CarShape& shape, const Outfit& outfit, double steering, double crank);

/// Who rides it.
const world::WalkerModel& rider_of(world::BodyStyle style);

/// The mesh of a shape. `model` matters for a trunk and a hem only.
Mesh limb_mesh(Limb::Shape shape, const world::WalkerModel& model);

}  // namespace reprise::render
