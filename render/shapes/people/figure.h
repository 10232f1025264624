#pragma once

#include <span>
#include <vector>

#include "render/shapes/cars/two_wheeler.h"
#include "render/shapes/mesh.h"
#include "render/shapes/people/figure_part.h"
#include "render/shapes/people/wardrobe.h"
#include "world/models/catalogue.h"
#include "world/tick.h"

namespace reprise::render {

/// What his clothes, skin and hair are drawn from (world::WalkerState::look); of one that was not
/// recorded (an imported run), from his id.
std::uint32_t appearance_bits(const world::WalkerState& walker);

/// Of the weather that was recorded, so that what there is to see does not depend on another one.
bool umbrellas_are_open(const world::TickView& tick);

/// The parts of a walker at his phase of the walk (see posture.h) with what he carries. Frame: x
/// ahead, on the ground between his feet. One who was hit lies on his back.
std::vector<FigurePart> figure(const world::WalkerModel& model,
                               const world::WalkerState& walker,
                               bool rains);

/// A rider in the frame of his upright two-wheeler. `steering` of its front wheel [rad]; `crank`
/// [rad], 0: left pedal down. `outfit` as drawn by the look of the vehicle.
std::vector<FigurePart> rider(const CarShape& shape,
                              const Outfit& outfit,
                              double steering,
                              double crank);

/// Who rides it.
const world::WalkerModel& rider_of(world::BodyStyle style);

/// The mesh of a shape. `model` matters for a trunk and a hem only.
Mesh figure_part_mesh(FigurePart::Shape shape, const world::WalkerModel& model);

}  // namespace reprise::render
