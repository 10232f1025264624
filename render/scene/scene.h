#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "render/scene/lane_raster.h"
#include "render/shapes/buildings/building_mesh.h"
#include "render/shapes/cars/car_shape.h"
#include "render/shapes/fast_math.h"
#include "render/shapes/people/figure_part.h"
#include "render/shapes/people/wardrobe.h"
#include "render/shapes/street/plot_mesh.h"
#include "render/trace/instance.h"
#include "render/trace/portable_tracer.h"
#include "world/tick.h"
#include "world/town_generated.h"

struct RTCSceneTy;

namespace reprise::render {

/// A building's frame, for painting its faces.
struct BuildingFrame {
    Eigen::Vector3f centre;
    float cosine;
    float sine;
    Eigen::Vector2f half;
    Facade facade;
};

/// All geometry at a tick, in Embree, or in our own PortableTracer when pictures must be `portable`
/// between CPUs. Owns the device. The scene's frame is the world's, moved to
/// `origin` (whole metres), so that single precision stays exact to 0.1 mm far from the map's zero.
class Scene {
  public:
    Scene(const world::TownT& town, bool portable);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// Places everybody. The actors in `mounts` can be hidden from rays, see mask_hiding.
    /// Nothing is kept from the last tick: the same tick gives the same tree. 0.5 ms for 100 cars.
    /// Umbrellas are open when it rains in the tick: what there is to see does not depend on the
    /// weather that pictures are made under.
    void place(const world::TickView& tick, std::span<const std::uint32_t> mounts);

    /// For rays of a camera that sits inside this actor.
    std::uint32_t mask_hiding(std::uint32_t actor) const;

    RTCSceneTy* tree() const { return top_; }

    /// Instead of tree() when pictures must be portable; else none.
    const PortableTracer* portable_tracer() const {
        return portable_tracer_ ? &*portable_tracer_ : nullptr;
    }

    std::span<const Instance> instances() const { return instances_; }

    std::span<const world::SignalColor> signals() const { return signals_; }

    std::span<const BuildingFrame> buildings() const { return buildings_; }

    const Facades& facades() const { return facades_; }

    std::span<const PlotFrame> plots() const { return plots_; }

    const CarShape& car_shape(std::uint16_t model) const { return car_shapes_[model]; }

    std::span<const Outfit> outfits() const { return outfits_; }

    const LaneRaster& lanes() const { return lanes_; }

    const Eigen::Vector3d& origin() const { return origin_; }

  private:
    struct Device;

    const Prototype* add_prototype(Mesh mesh);
    void build_town(const world::TownT& town);
    void place_trees(const world::TownT& town);
    void place_props(const world::TownT& town);
    void park(const world::Prop& prop);
    void build_models();
    void build_people();
    Instance body_of(std::uint32_t id,
                     std::uint16_t model,
                     std::uint16_t lamps,
                     std::span<const world::Look> looks) const;
    void place_car(const Eigen::Isometry3d& pose_world_car,
                   const Instance& body,
                   double steering,
                   std::span<const world::WheelState> wheels,
                   double roll);
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
    void add_instance(Instance instance, const Eigen::Affine3d& pose_world);
    void commit();

    std::unique_ptr<Device> device_;  // none when portable
    RTCSceneTy* top_ = nullptr;
    std::optional<PortableTracer> portable_tracer_;
    Eigen::Vector3d origin_;
    LaneRaster lanes_;
    std::deque<Prototype> prototypes_;  // a deque keeps their addresses
    std::vector<CarShape> car_shapes_;
    std::vector<const Prototype*> car_bodies_;
    const Prototype* door_ = nullptr;
    std::vector<const Prototype*> things_;  // by model of a scenario's props
    std::vector<const Prototype*> wheels_;
    std::vector<const Prototype*> forks_;   // of two-wheelers, else none
    std::vector<const Prototype*> cranks_;  // of bicycles, else none
    // Of the pedestrian models, then of the riders of a motorcycle and a bicycle.
    std::vector<const Prototype*> trunks_;
    std::vector<const Prototype*> hems_;
    std::array<const Prototype*, figure_part_shapes> figure_parts_{};  // by FigurePart::Shape
    std::vector<Outfit> outfits_;
    std::vector<BuildingFrame> buildings_;
    Facades facades_;
    std::vector<PlotFrame> plots_;
    std::vector<Instance> town_;  // the instances that never move
    std::vector<Instance> instances_;
    std::vector<world::SignalColor> signals_;
    std::vector<std::uint32_t> mounts_;
};

}  // namespace reprise::render
