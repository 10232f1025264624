#include <cmath>
#include <numbers>
#include <string>

#include "render/scene/motion.h"
#include "render/scene/scene.h"
#include "render/scene/twist.h"
#include "render/shapes/cars/two_wheeler.h"
#include "render/shapes/noise.h"
#include "render/shapes/paint.h"
#include "render/shapes/people/figure.h"
#include "render/shapes/street/thing_mesh.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/models/actors.h"
#include "world/models/doors.h"
#include "world/models/prop_models.h"

namespace reprise::render {

using Eigen::Vector3d;

/// What an actor's own triangles have in common. Traces from before looks were recorded: by id.
Instance Scene::body_of(std::uint32_t id,
                        std::uint16_t model,
                        std::uint16_t lamps,
                        std::span<const world::Look> looks) const {
    REPRISE_CHECK(model < town_.prototypes().car_bodies.size(), "vehicle " + std::to_string(id));
    const world::Look* look = world::find(looks, id);
    Instance body;
    body.actor = id;
    body.model = model;
    body.lamps = lamps;
    body.look = look != nullptr ? look->look() : hash(id);
    body.color = paint_of(world::vehicle_models()[model], body.look).body;
    return body;
}

void Scene::place_vehicles(const world::TickView& tick) {
    std::span<const world::WheelState> wheels = tick.wheels();
    for (const world::VehicleState& vehicle : tick.vehicles()) {
        while (!wheels.empty() && wheels.front().vehicle() < vehicle.id())
            wheels = wheels.subspan(1);
        std::size_t own = 0;
        while (own < wheels.size() && wheels[own].vehicle() == vehicle.id())
            ++own;
        const Instance body =
            body_of(vehicle.id(), vehicle.model(), vehicle.lamps(), tick.vehicle_looks());
        if (!world::is_two_wheeler(world::vehicle_models()[vehicle.model()].body)) {
            town_.add_car(moving_,
                          world::pose(vehicle.position(), vehicle.orientation()),
                          body,
                          vehicle.steering_angle(),
                          wheels.first(own),
                          0);
            continue;
        }
        place_two_wheeler(
            leaning_pose(vehicle), body, vehicle.steering_angle(), vehicle.odometer());
    }
}

void Scene::place_cars(const world::TickView& tick) {
    for (const world::CarState& car : tick.cars()) {
        const Instance body = body_of(car.id(), car.model(), car.lamps(), tick.car_looks());
        const Eigen::Isometry3d pose = world::pose(
            car.position(), static_cast<double>(car.yaw()), static_cast<double>(car.pitch()));
        const world::VehicleModel& model = *car_shape(car.model()).model;
        const auto rolled = static_cast<double>(car.lane_s());
        if (world::is_two_wheeler(model.body))
            place_two_wheeler(pose, body, town_.steering_of(car), rolled);
        else
            town_.add_car(
                moving_, pose, body, town_.steering_of(car), {}, rolled / model.wheel_radius);
    }
}

/// A sign that broke off looks as it did when it stood. False: it is none.
bool Scene::place_broken(const world::PropState& prop) {
    if (prop.id() < world::first_broken_id || prop.id() > world::last_broken_id ||
        prop.id() - world::first_broken_id >= town_.props().size())
        return false;
    const TownScene::PlacedProp& placed = town_.props()[prop.id() - world::first_broken_id];
    Instance instance = town_.instances()[placed.instance];
    instance.actor = prop.id();
    Eigen::Affine3d pose(world::pose(prop.position(), prop.orientation()));
    pose.scale(placed.stretch);
    add_instance(instance, pose);
    return true;
}

void Scene::place_things(const world::TickView& tick) {
    std::vector<std::size_t> broken;
    for (const world::PropState& prop : tick.props()) {
        if (place_broken(prop)) {
            broken.push_back(town_.props()[prop.id() - world::first_broken_id].instance);
            continue;
        }
        REPRISE_CHECK(prop.model() < town_.prototypes().things.size(),
                      "prop " + std::to_string(prop.id()));
        Instance instance;
        instance.kind = Kind::thing;
        instance.prototype = town_.prototypes().things[prop.model()].get();
        instance.actor = prop.id();
        add_instance(instance, Eigen::Affine3d(world::pose(prop.position(), prop.orientation())));
    }
    take_down(std::move(broken));
}

/// Beside the shut ones, which are painted onto the body.
void Scene::place_doors(const world::TickView& tick) {
    for (const world::Door& door : tick.doors()) {
        const world::VehicleState* vehicle = world::find(tick.vehicles(), door.actor());
        const world::CarState* car = world::find(tick.cars(), door.actor());
        const auto pose = world::find_pose(tick, door.actor());
        if (!pose || (vehicle == nullptr && car == nullptr))
            continue;
        Instance part = vehicle != nullptr
                            ? body_of(vehicle->id(), vehicle->model(), 0, tick.vehicle_looks())
                            : body_of(car->id(), car->model(), 0, tick.car_looks());
        const world::DoorLeaf leaf =
            world::door_leaf(world::vehicle_models()[part.model], *pose, door.door(), door.angle());
        part.kind = Kind::car_body;
        part.prototype = town_.prototypes().door->get();
        Eigen::Affine3d stretched(leaf.pose);
        stretched.scale(2 * leaf.half);
        add_instance(part, stretched);
    }
}

void Scene::move_back(const world::TickView& tick, double ago) {
    const Eigen::Translation3d to_world(town_.origin());
    std::uint32_t last = 0;
    Eigen::Affine3d moved;
    for (Instance& instance : moving_) {
        if (instance.actor == 0)
            continue;
        if (instance.actor != last) {
            last = instance.actor;
            const auto twist = find_twist(tick, last);
            moved = twist ? to_world.inverse() * Eigen::Affine3d(twist->back(ago)) * to_world
                          : Eigen::Affine3d::Identity();
        }
        instance.pose = moved * instance.pose;
        instance.moved = true;
        instance.normal_to_scene = moved.linear().cast<float>() * instance.normal_to_scene;
    }
}

void Scene::place(const world::TickView& tick, std::span<const std::uint32_t> mounts, double ago) {
    mounts_.assign(mounts.begin(), mounts.end());
    arrange(tick);
    if (ago > 0)
        move_back(tick, ago);
    hide_mounts();
    commit();
}

void Scene::place_each(const world::TickView& tick,
                       std::span<const std::uint32_t> mounts,
                       std::span<const Moment> moments,
                       const std::function<void(std::size_t)>& look) {
    mounts_.assign(mounts.begin(), mounts.end());
    arrange(tick);
    hide_mounts();
    const std::vector<Instance> at_tick = moving_;
    for (std::size_t i = 0; i < moments.size(); ++i) {
        moving_ = at_tick;
        if (moments[i].ago > 0)
            move_back(tick, moments[i].ago);
        commit(moments[i].ball);
        look(i);
    }
}

void Scene::place_along(const world::TickView& tick,
                        std::span<const std::uint32_t> mounts,
                        std::span<const Motion> motions,
                        double share) {
    mounts_.assign(mounts.begin(), mounts.end());
    arrange(tick);
    REPRISE_CHECK(motions.size() == moving_.size(), std::to_string(motions.size()) + " motions");
    for (std::size_t i = 0; i < moving_.size(); ++i) {
        if (!motions[i].moves)
            continue;
        const Eigen::Affine3d moved = motions[i].at(share);
        moving_[i].pose = moved * moving_[i].pose;
        moving_[i].moved = true;
        moving_[i].normal_to_scene = moved.linear().cast<float>() * moving_[i].normal_to_scene;
    }
    hide_mounts();
    commit();
}

void Scene::arrange(const world::TickView& tick) {
    signals_.assign(tick.signals().begin(), tick.signals().end());
    moving_.clear();
    outfits_.clear();
    place_vehicles(tick);
    place_cars(tick);
    place_things(tick);
    place_doors(tick);
    const bool rains = umbrellas_are_open(tick);
    for (const world::WalkerState& walker : tick.walkers())
        place_walker(walker, rains);
}

}  // namespace reprise::render
