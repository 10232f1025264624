#include "render/optics/stage.h"

namespace reprise::render {

Stage::Stage(Scene& scene,
             const Scene* last,
             const world::TickView& tick,
             std::span<const std::uint32_t> mounts,
             double step)
    : scene_(scene),
      tick_(tick),
      mounts_(mounts.begin(), mounts.end()),
      step_(step) {
    if (last != nullptr)
        motions_ = motions(scene, *last);
}

void Stage::go_back(double ago) {
    const double wanted = motions_.empty() ? 0.0 : share(ago);
    if (wanted == placed_)
        return;
    placed_ = wanted;
    if (wanted == 0)
        scene_.place(tick_, mounts_);
    else
        scene_.place_along(tick_, mounts_, motions_, wanted);
}

}  // namespace reprise::render
