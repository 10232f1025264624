#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/scene/crowd_map.h"
#include "render/scene/tick_tree.h"
#include "render/scene/town_scene.h"
#include "render/shapes/people/wardrobe.h"

namespace reprise::render {

struct Motion;

/// All geometry at a tick: a town, which is borrowed, and everybody in it. Instances of the town
/// are numbered first, then those of the tick.
class Scene {
  public:
    explicit Scene(const TownScene& town) : town_(town) {}

    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// Places everybody. The actors in `mounts` can be hidden from rays, see mask_hiding.
    /// The same tick gives the same tree, whatever the last one was. 1.1 ms for 100 cars and 50
    /// walkers. Umbrellas are open when it rains in the tick: what there is to see does not depend
    /// on the weather that pictures are made under. `ago`: where they were so many seconds before,
    /// as far as the tick tells, see Twist::back; limbs, wheels and lamps are as at the tick.
    void place(const world::TickView& tick, std::span<const std::uint32_t> mounts, double ago = 0);

    /// A time of a tick, and where its rays stay.
    struct Moment {
        double ago = 0;  ///< [s]
        Ball ball;       ///< scene
    };

    /// As place() at each of these times, one behind the other; `look` is told which, and sees the
    /// scene there. Only who is in its ball is surely found. Half the cost of placing everybody
    /// each time.
    void place_each(const world::TickView& tick,
                    std::span<const std::uint32_t> mounts,
                    std::span<const Moment> moments,
                    const std::function<void(std::size_t)>& look);

    /// As place(), everybody a share of the way along `motions`, which are of the tick's parts.
    void place_along(const world::TickView& tick,
                     std::span<const std::uint32_t> mounts,
                     std::span<const Motion> motions,
                     double share);

    /// As place(), only to know where everybody is: rays find nobody.
    void arrange(const world::TickView& tick);

    /// For rays of a camera that sits inside this actor.
    std::uint32_t mask_hiding(std::uint32_t actor) const;

    const TownScene& town() const { return town_; }

    /// Embree's tree of the town, without what broke off; none when pictures must be portable.
    RTCSceneTy* town_tree() const { return standing_ != nullptr ? standing_ : town_.tree(); }

    /// Embree's tree of who was placed; none when nobody was, or when pictures must be portable.
    RTCSceneTy* tree() const { return tree_ && !moving_.empty() ? tree_->handle() : nullptr; }

    /// Where in that tree short rays may meet somebody: anywhere, until map_crowd() has looked.
    const CrowdMap& crowd() const { return crowd_; }

    /// Pays where many short rays follow, as in pictures of light. 0.07 ms for 100 cars and 50
    /// walkers.
    void map_crowd();

    /// Instead of Embree's trees when pictures must be portable: of the town and who is in it.
    const PortableTracer* portable_tracer() const {
        return portable_tracer_ ? &*portable_tracer_ : nullptr;
    }

    const Instance& instance(std::uint32_t number) const {
        const std::span<const Instance> still = town_.instances();
        return number < still.size() ? still[number] : moving_[number - still.size()];
    }

    /// Those that are not of the town.
    std::span<const Instance> moving() const { return moving_; }

    std::span<const world::SignalColor> signals() const { return signals_; }

    std::span<const BuildingFrame> buildings() const { return town_.buildings(); }

    const Facades& facades() const { return town_.facades(); }

    std::span<const PlotFrame> plots() const { return town_.plots(); }

    const CarShape& car_shape(std::uint16_t model) const {
        return town_.prototypes().car_shapes[model];
    }

    std::span<const Outfit> outfits() const { return outfits_; }

    const LaneRaster& lanes() const { return town_.lanes(); }

    const Eigen::Vector3d& origin() const { return town_.origin(); }

  private:
    Instance body_of(std::uint32_t id,
                     std::uint16_t model,
                     std::uint16_t lamps,
                     std::span<const world::Look> looks) const;
    void place_two_wheeler(const Eigen::Isometry3d& pose_world_vehicle,
                           const Instance& body,
                           double steering,
                           double rolled);
    void place_vehicles(const world::TickView& tick);
    void place_cars(const world::TickView& tick);
    void place_things(const world::TickView& tick);
    void place_doors(const world::TickView& tick);
    void place_walker(const world::WalkerState& walker, bool rains);
    void place_figure(std::span<const FigurePart> figure,
                      std::size_t person,
                      const Eigen::Isometry3d& pose,
                      Instance part);

    void add_instance(const Instance& instance, const Eigen::Affine3d& pose_world) {
        town_.add_instance(moving_, instance, pose_world);
    }

    bool place_broken(const world::PropState& prop);
    void take_down(std::vector<std::size_t> broken);
    void hide_mounts();
    void move_back(const world::TickView& tick, double ago);
    void commit(const Ball& ball = {});

    const TownScene& town_;
    std::vector<Instance> moving_;
    std::optional<TickTree> tree_;
    CrowdMap crowd_;
    std::vector<std::size_t> broken_;  // of the town's instances, sorted: what stands no longer
    RTCSceneTy* standing_ = nullptr;   // the town without them; none: nothing is broken
    std::optional<PortableTracer> portable_standing_;
    std::optional<PortableTracer> portable_tracer_;
    std::vector<Outfit> outfits_;
    std::vector<world::SignalColor> signals_;
    std::vector<std::uint32_t> mounts_;
};

}  // namespace reprise::render
