#include <cmath>
#include <numbers>
#include <string>

#include "render/figure.h"
#include "render/scene.h"
#include "world/check.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

double mean_length(std::span<const world::WheelState> wheels) {
    double sum = 0;
    for (const world::WheelState& wheel : wheels)
        sum += wheel.suspension_length();
    return sum / static_cast<double>(wheels.size());
}

}  // namespace

void Scene::build_models() {
    for (const world::VehicleModel& model : world::vehicle_models()) {
        car_shapes_.emplace_back(model);
        car_bodies_.push_back(add_prototype(car_body_mesh(car_shapes_.back())));
        wheels_.push_back(add_prototype(wheel_mesh(car_shapes_.back())));
    }
    ball_ = add_prototype(ball_mesh());
    bone_ = add_prototype(bone_mesh());
}

void Scene::place_car(const Eigen::Isometry3d& pose_world_car,
                      const Instance& body,
                      double steering,
                      std::span<const world::WheelState> wheels,
                      double roll) {
    const world::VehicleModel& model = *car_shape(body.model).model;
    Instance part = body;
    part.kind = Kind::car_body;
    part.prototype = car_bodies_[body.model];
    add_instance(part, pose_world_car);
    part.kind = Kind::wheel;
    part.prototype = wheels_[body.model];
    for (std::size_t i = 0; i < 4; ++i) {
        const bool ahead = i < 2;
        const double side = i % 2 == 0 ? 1 : -1;
        Vector3d centre(ahead ? model.wheelbase : 0, side * model.track / 2, model.wheel_radius);
        double turn = ahead ? steering : 0;
        double rotation = roll;
        if (wheels.size() == 4) {
            turn = wheels[i].steering_angle();
            rotation = wheels[i].rotation();
            // A wheel that is pressed in more than the others sits higher in the body.
            centre.z() += mean_length(wheels) - wheels[i].suspension_length();
        }
        Eigen::Affine3d pose(pose_world_car * Eigen::Translation3d(centre));
        pose.rotate(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
        pose.rotate(Eigen::AngleAxisd(rotation, Vector3d::UnitY()));
        if (side < 0)
            pose.rotate(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitZ()));
        add_instance(part, pose);
    }
}

void Scene::place_walker(const world::WalkerState& walker) {
    const auto models = world::walker_models();
    REPRISE_CHECK(walker.model() < models.size(), "walker " + std::to_string(walker.id()));
    const Eigen::Isometry3d pose =
        world::pose(walker.position(), static_cast<double>(walker.yaw()), 0);
    Instance part;
    part.kind = Kind::limb;
    part.actor = walker.id();
    for (const Limb& limb : figure(models[walker.model()], walker)) {
        part.material = limb.material;
        part.prototype = limb.shape == Limb::Shape::ball ? ball_ : bone_;
        add_instance(part, pose * limb.pose);
    }
}

void Scene::place(const world::TickView& tick, std::span<const std::uint32_t> mounts) {
    mounts_.assign(mounts.begin(), mounts.end());
    signals_.assign(tick.signals().begin(), tick.signals().end());
    instances_ = town_;
    const auto body_of = [&](std::uint32_t id, std::uint16_t model, std::uint16_t lamps) {
        REPRISE_CHECK(model < car_bodies_.size(), "vehicle " + std::to_string(id));
        Instance body;
        body.actor = id;
        body.model = model;
        body.lamps = lamps;
        return body;
    };
    std::span<const world::WheelState> wheels = tick.wheels();
    for (const world::VehicleState& vehicle : tick.vehicles()) {
        while (!wheels.empty() && wheels.front().vehicle() < vehicle.id())
            wheels = wheels.subspan(1);
        std::size_t own = 0;
        while (own < wheels.size() && wheels[own].vehicle() == vehicle.id())
            ++own;
        place_car(world::pose(vehicle.position(), vehicle.orientation()),
                  body_of(vehicle.id(), vehicle.model(), vehicle.lamps()),
                  vehicle.steering_angle(),
                  wheels.first(own),
                  0);
    }
    for (const world::CarState& car : tick.cars()) {
        const Instance body = body_of(car.id(), car.model(), car.lamps());
        const double radius = car_shape(car.model()).model->wheel_radius;
        place_car(
            world::pose(
                car.position(), static_cast<double>(car.yaw()), static_cast<double>(car.pitch())),
            body,
            0,
            {},
            static_cast<double>(car.lane_s()) / radius);
    }
    for (const world::WalkerState& walker : tick.walkers())
        place_walker(walker);
    commit();
}

std::optional<Eigen::Isometry3d> Scene::find_actor(const world::TickView& tick,
                                                   std::uint32_t actor) {
    if (const world::VehicleState* vehicle = world::find(tick.vehicles(), actor))
        return world::pose(vehicle->position(), vehicle->orientation());
    if (const world::CarState* car = world::find(tick.cars(), actor))
        return world::pose(
            car->position(), static_cast<double>(car->yaw()), static_cast<double>(car->pitch()));
    if (const world::WalkerState* walker = world::find(tick.walkers(), actor))
        return world::pose(walker->position(), static_cast<double>(walker->yaw()), 0);
    return std::nullopt;
}

}  // namespace reprise::render
