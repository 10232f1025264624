#include "kernel/physics/solid_ground.h"

#include <utility>

#include "kernel/physics/ground.h"

namespace reprise::kernel {

SolidGround::SolidGround(ground::GroundMesh mesh)
    : mesh_(std::move(mesh)),
      in_bullet_(std::make_unique<const Ground>(mesh_)) {}

SolidGround::~SolidGround() = default;

}  // namespace reprise::kernel
