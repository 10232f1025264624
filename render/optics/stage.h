#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "render/scene/motion.h"
#include "render/trace/camera.h"

namespace reprise::render {

/// A camera at a tick and, where that is known, at the one before.
struct Sight {
    Camera now;
    std::optional<Camera> last;
    std::uint32_t mask;

    /// On a share of its way back to the last tick, straight and with an even turn.
    Camera at(double share) const { return last ? now.towards(*last, share) : now; }
};

/// Everybody at any instant between the last tick and a tick. Without a last one they stand still.
class Stage {
  public:
    /// `scene` is placed at the tick, `last` arranged at the last one, both for as long as this is
    /// used; `step` [s] is between them.
    Stage(Scene& scene,
          const Scene* last,
          const world::TickView& tick,
          std::span<const std::uint32_t> mounts,
          double step);

    /// Places the scene so long before the tick [s]; longer than a tick ago is not known.
    void go_back(double ago);

    /// How far it is from the tick to the last one then. In [0, 1]
    double share(double ago) const { return std::clamp(ago / step_, 0.0, 1.0); }

    const Scene& scene() const { return scene_; }

    /// After others have placed the scene.
    void forget_place() { placed_ = -1; }

  private:
    Scene& scene_;
    world::TickView tick_;
    std::vector<std::uint32_t> mounts_;
    std::vector<Motion> motions_;
    double step_;
    double placed_ = 0;  ///< share; below 0: not known
};

}  // namespace reprise::render
