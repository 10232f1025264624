#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "ground/mesh/ground.h"

/// A plumb line to drop on the ground of a place.
namespace reprise::test {

struct Hit {
    double z = 0;
    ground::Surface surface = ground::Surface::terrain;
};

/// What a plumb line that starts at `from` meets first. Slow and simple, on purpose.
std::optional<Hit> plumb(const ground::GroundMesh& mesh, const Eigen::Vector3d& from);

/// Digest of all bytes of a mesh.
std::string bytes_of(const ground::GroundMesh& mesh);

}  // namespace reprise::test
