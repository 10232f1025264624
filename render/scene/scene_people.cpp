#include <numbers>
#include <string>

#include "render/scene/scene.h"
#include "render/shapes/people/figure.h"
#include "world/check.h"
#include "world/frames.h"

namespace reprise::render {

/// `person`: whose trunk it is, index in Prototypes::trunks.
void Scene::place_figure(std::span<const FigurePart> figure,
                         std::size_t person,
                         const Eigen::Isometry3d& pose,
                         Instance part) {
    part.outfit = static_cast<std::uint16_t>(outfits_.size() - 1);
    for (const FigurePart& piece : figure) {
        part.material = piece.material;
        part.prototype =
            piece.shape == FigurePart::Shape::trunk ? town_.prototypes().trunks[person].get()
            : piece.shape == FigurePart::Shape::hem
                ? town_.prototypes().hems[person].get()
                : town_.prototypes().figure_parts.at(static_cast<std::size_t>(piece.shape)).get();
        add_instance(part, pose * piece.pose);
    }
}

void Scene::place_walker(const world::WalkerState& walker, bool rains) {
    const auto models = world::walker_models();
    REPRISE_CHECK(walker.model() < models.size(), "walker " + std::to_string(walker.id()));
    const world::WalkerModel& model = models[walker.model()];
    outfits_.push_back(outfit_of(model, appearance_bits(walker)));
    Instance part;
    part.kind = Kind::pedestrian;
    part.actor = walker.id();
    place_figure(figure(model, walker, rains),
                 walker.model(),
                 world::pose(walker.position(), static_cast<double>(walker.yaw()), 0),
                 part);
}

void Scene::place_two_wheeler(const Eigen::Isometry3d& pose_world_vehicle,
                              const Instance& body,
                              double steering,
                              double rolled) {
    const CarShape& shape = car_shape(body.model);
    const world::VehicleModel& model = *shape.model;
    Instance part = body;
    part.kind = Kind::car_body;
    part.prototype = town_.prototypes().car_bodies[body.model].get();
    add_instance(part, pose_world_vehicle);
    const Eigen::Isometry3d pose_world_fork = pose_world_vehicle *
                                              Eigen::Translation3d(model.wheelbase, 0, 0) *
                                              Eigen::AngleAxisd(steering, Eigen::Vector3d::UnitZ());
    part.prototype = town_.prototypes().forks[body.model].get();
    add_instance(part, pose_world_fork);

    part.kind = Kind::wheel;
    part.prototype = town_.prototypes().wheels[body.model].get();
    const Eigen::Isometry3d turned =
        Eigen::Translation3d(0, 0, model.wheel_radius) *
        Eigen::AngleAxisd(rolled / model.wheel_radius, Eigen::Vector3d::UnitY()) *
        Eigen::Isometry3d::Identity();
    add_instance(part, pose_world_vehicle * turned);
    add_instance(part, pose_world_fork * turned);

    constexpr double development = 5.0;  // [m] that a bicycle rolls in a turn of its cranks
    const Seat seat = seat_of(shape);
    const double crank = seat.crank > 0 ? 2 * std::numbers::pi * rolled / development : 0;
    if (seat.crank > 0) {
        part.kind = Kind::car_body;
        part.prototype = town_.prototypes().cranks[body.model].get();
        for (const double side : {1.0, -1.0}) {
            const Eigen::Vector3d middle(seat.foot.x(), side * 0.05, seat.foot.z());
            const double angle = crank + (side > 0 ? 0 : std::numbers::pi);
            Eigen::Affine3d pose(pose_world_vehicle * Eigen::Translation3d(middle) *
                                 Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
            if (side < 0)
                pose.rotate(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
            add_instance(part, pose);
        }
    }

    outfits_.push_back(outfit_of(rider_of(shape.style), body.look));
    part.kind = Kind::rider;
    const std::size_t person =
        world::walker_models().size() + (shape.style == world::BodyStyle::bicycle ? 1 : 0);
    place_figure(rider(shape, outfits_.back(), steering, crank), person, pose_world_vehicle, part);
}

}  // namespace reprise::render
