// What it must do: say where the surface in each pixel is seen at another tick, exactly.
// What it assumes: an actor's parts are placed in the same order at every tick (scene_actors.cpp).
// How it goes: the place is taken into its part's frame, and out again where that part is at the
//   other tick; the other camera says where that is seen. What stays, stays; the sky is far away.
// What it keeps: nothing.
#include "render/labels/flow.h"

#include <cstring>
#include <limits>

#include <tbb/parallel_for.h>

#include "render/scene/motion.h"
#include "render/trace/default_float_mode.h"
#include "render/trace/ray.h"

namespace reprise::render {

namespace {

class Flow {
  public:
    Flow(const Scene& scene, const Camera& camera, const OtherTick& other)
        : scene_(scene),
          camera_(camera),
          other_(other),
          partners_(partners(scene, other.scene)) {
        for (std::size_t i = 0; i < partners_.size(); ++i)
            carried_.push_back(partners_[i] == nullptr
                                   ? Eigen::Affine3d::Identity()
                                   : partners_[i]->pose * scene.moving()[i].pose.inverse());
    }

    /// [px] in the other picture; not a number where it is not known.
    Eigen::Vector2d place(const Hit& hit, const Eigen::Vector3d& ray) const {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        // So far that the way of a camera between two ticks does not matter.
        if (hit.instance == no_instance)
            return seen(other_.camera.position() + 1e9 * ray);
        Eigen::Vector3d p_scene = camera_.position() + static_cast<double>(hit.distance) * ray;
        const std::size_t still = scene_.town().instances().size();
        if (hit.instance >= still) {
            const std::size_t part = hit.instance - still;
            if (partners_[part] == nullptr)
                return {unknown, unknown};
            p_scene = carried_[part] * p_scene;
        }
        return seen(p_scene);
    }

  private:
    Eigen::Vector2d seen(const Eigen::Vector3d& p_scene) const {
        const Eigen::Vector3d at = other_.camera.project(p_scene);
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        return at.z() > 0 ? Eigen::Vector2d(at.head<2>()) : Eigen::Vector2d(unknown, unknown);
    }

    const Scene& scene_;
    const Camera& camera_;
    const OtherTick& other_;
    std::vector<const Instance*> partners_;
    std::vector<Eigen::Affine3d> carried_;  ///< this tick's place of a part to the other's
};

}  // namespace

std::vector<std::uint8_t> flow_bytes(const Scene& scene,
                                     const Camera& camera,
                                     const std::vector<Hit>& hits,
                                     const OtherTick* other,
                                     bool forward) {
    std::vector<std::uint8_t> bytes(hits.size() * sizeof(Eigen::Vector2f));
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    std::optional<Flow> flow;
    if (other != nullptr)
        flow.emplace(scene, camera, *other);
    tbb::parallel_for(0, camera.height(), [&](int y) {
        const DefaultFloatMode plain;
        for (int x = 0; x < camera.width(); ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width()) +
                           static_cast<std::size_t>(x);
            Eigen::Vector2f motion(unknown, unknown);
            if (flow) {
                const Eigen::Vector2d here(x + 0.5, y + 0.5);
                const Eigen::Vector2d there = flow->place(hits[i], camera.ray(here.x(), here.y()));
                // The sign of what is not a number is not the same everywhere: ours is.
                if (there.allFinite())
                    motion = (forward ? there - here : here - there).cast<float>();
            }
            std::memcpy(bytes.data() + i * sizeof(motion), motion.data(), sizeof(motion));
        }
    });
    return bytes;
}

}  // namespace reprise::render
