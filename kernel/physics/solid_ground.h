#pragma once

#include <memory>

#include "ground/mesh/ground.h"

namespace reprise::kernel {

class Ground;

/// A town's ground, ready for any number of kernels, one after the other: its mesh, and what
/// Bullet searches it by. Of Town 1 that takes 40 and 6 ms.
class SolidGround {
  public:
    explicit SolidGround(ground::GroundMesh mesh);
    ~SolidGround();
    SolidGround(const SolidGround&) = delete;
    SolidGround& operator=(const SolidGround&) = delete;

    const ground::GroundMesh& mesh() const { return mesh_; }

    const Ground& in_bullet() const { return *in_bullet_; }

  private:
    ground::GroundMesh mesh_;
    std::unique_ptr<const Ground> in_bullet_;
};

}  // namespace reprise::kernel
