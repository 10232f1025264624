#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "render/scene/lane_headings.h"
#include "render/scene/lane_raster.h"
#include "render/scene/late_prototype.h"
#include "render/scene/shelter.h"
#include "render/scene/town_lamps.h"
#include "render/shapes/buildings/building_mesh.h"
#include "render/shapes/cars/car_shape.h"
#include "render/shapes/people/figure_part.h"
#include "render/shapes/street/plot_mesh.h"
#include "render/trace/instance.h"
#include "render/trace/portable_tracer.h"
#include "world/tick.h"
#include "world/town_generated.h"

struct RTCDeviceTy;
struct RTCGeometryTy;
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

/// The shapes of all that can be anywhere: what is placed is an instance of one of these.
struct Prototypes {
    std::vector<CarShape> car_shapes;  // by model, as those that follow
    std::deque<LatePrototype> car_bodies;
    std::deque<LatePrototype> wheels;
    std::deque<LatePrototype> forks;   // of two-wheelers; nobody asks for the others'
    std::deque<LatePrototype> cranks;  // likewise of bicycles
    std::optional<LatePrototype> door;
    std::deque<LatePrototype> things;  // by model of a scenario's props
    // Of the pedestrian models, then of the riders of a motorcycle and a bicycle.
    std::deque<LatePrototype> trunks;
    std::deque<LatePrototype> hems;
    std::deque<LatePrototype> figure_parts;  // by FigurePart::Shape
};

/// Tells Embree where an instance's geometry is.
void set_pose(RTCGeometryTy* geometry, const Instance& instance);

/// All that stays: the town, in Embree, or in our own PortableTracer when pictures must be
/// `portable` between CPUs, and the shapes of all that moves in it. Owns the device. The scene's
/// frame is the world's, moved to `origin` (whole metres), so that single precision stays exact to
/// 0.1 mm far from the map's zero. Never changes: any number of Scenes may borrow it at once.
class TownScene {
  public:
    TownScene(const world::TownT& town, bool portable);
    ~TownScene();
    TownScene(const TownScene&) = delete;
    TownScene& operator=(const TownScene&) = delete;

    /// Embree's tree of these instances, whose numbers are its ids; to be released by the caller;
    /// none when portable.
    RTCSceneTy* tree_of(std::span<const Instance> instances) const;

    /// Such a tree to come, one instance after the other. Not when portable.
    RTCSceneTy* new_tree() const;
    void attach(RTCSceneTy* tree, const Instance& instance, unsigned id) const;

    /// Did Embree do what it was asked to since it was asked last?
    void check() const;

    RTCSceneTy* tree() const { return tree_; }

    /// Instead of tree() when pictures must be portable; else none.
    const PortableTracer* portable_tracer() const {
        return portable_tracer_ ? &*portable_tracer_ : nullptr;
    }

    std::span<const Instance> instances() const { return instances_; }

    /// Where one of Town.props is among instances(), and how its mesh is stretched there.
    struct PlacedProp {
        std::size_t instance = 0;
        Eigen::Vector3d stretch{1, 1, 1};
    };

    /// [i] belongs to Town.props[i].
    std::span<const PlacedProp> props() const { return props_; }

    const Prototypes& prototypes() const { return prototypes_; }

    std::span<const BuildingFrame> buildings() const { return buildings_; }

    const Facades& facades() const { return facades_; }

    std::span<const PlotFrame> plots() const { return plots_; }

    const TownLamps& lamps() const { return lamps_; }

    const LaneRaster& lanes() const { return lanes_; }

    /// How far the front wheels of a car of the traffic are turned: along its lane, where they are.
    /// [rad] to the left; 0 off the lanes.
    double steering_of(const world::CarState& car) const;

    /// 1 + the number in world::TownThings of what an instance's triangle is of; 0: of none.
    std::uint32_t thing_of(const Instance& instance, std::uint32_t triangle) const;

    const Eigen::Vector3d& origin() const { return origin_; }

    /// Height of the town's lowest ground in the scene's frame. [m]
    float ground() const { return ground_; }

    /// Made when the first picture asks for it: in dry weather nobody does.
    const Shelter& shelter() const {
        std::call_once(shelter_asked_, [this] {
            // The first is the land around the town: nothing lies below its hills.
            shelter_.emplace(std::span<const Instance>(instances_).subspan(1));
        });
        return *shelter_;
    }

    /// Adds an instance in its place, in the scene's frame.
    void add_instance(std::vector<Instance>& instances,
                      const Instance& instance,
                      const Eigen::Affine3d& pose_world) const;

    /// Adds a car's body and its wheels.
    void add_car(std::vector<Instance>& instances,
                 const Eigen::Isometry3d& pose_world_car,
                 const Instance& body,
                 double steering,
                 std::span<const world::WheelState> wheels,
                 double roll) const;

  private:
    struct Device;

    Prototype make_prototype(Mesh mesh) const;
    const Prototype* add_prototype(Mesh mesh);
    template <typename MakeMesh>
    std::function<Prototype()> maker(const MakeMesh& make_mesh) const;
    void name_models();
    void name_people();
    void build_town(const world::TownT& town);
    void place_trees(const world::TownT& town);
    void place_props(const world::TownT& town);
    void park(const world::Prop& prop, std::uint32_t thing);
    Mesh build_things(const world::TownT& town);

    std::unique_ptr<Device> device_;  // none when portable
    Eigen::Vector3d origin_;
    float ground_;
    LaneRaster lanes_;
    LaneHeadings headings_;
    mutable std::once_flag shelter_asked_;
    mutable std::optional<Shelter> shelter_;
    std::deque<Prototype> meshes_;  // a deque keeps their addresses
    Prototypes prototypes_;
    std::vector<BuildingFrame> buildings_;
    Facades facades_;
    std::vector<PlotFrame> plots_;
    TownLamps lamps_;
    std::vector<Instance> instances_;
    std::vector<PlacedProp> props_;
    std::vector<std::uint32_t>
        thing_ends_;  ///< of the town's own mesh: behind each one's triangles
    RTCSceneTy* tree_ = nullptr;
    std::optional<PortableTracer> portable_tracer_;
};

}  // namespace reprise::render
