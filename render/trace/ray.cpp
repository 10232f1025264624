#include "render/trace/ray.h"

namespace reprise::render {

bool is_valid(const Ray& ray) {
    constexpr float most = 1e18F;
    return ray.origin.cwiseAbs().maxCoeff() < most && ray.direction.cwiseAbs().maxCoeff() < most &&
           ray.direction.squaredNorm() > 1e-12F && ray.far >= 0;
}

}  // namespace reprise::render
