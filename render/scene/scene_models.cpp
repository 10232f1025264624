#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "render/scene/town_scene.h"
#include "render/shapes/cars/two_wheeler.h"
#include "render/shapes/people/figure.h"
#include "render/shapes/street/thing_mesh.h"
#include "world/models/actors.h"
#include "world/models/doors.h"

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

template <typename MakeMesh>
std::function<Prototype()> TownScene::maker(const MakeMesh& make_mesh) const {
    return [this, make_mesh] { return make_prototype(make_mesh()); };
}

void TownScene::name_models() {
    for (const world::VehicleModel& model : world::vehicle_models())
        prototypes_.car_shapes.emplace_back(model);
    for (const CarShape& shape : prototypes_.car_shapes) {
        const bool thin = world::is_two_wheeler(shape.model->body);
        prototypes_.car_bodies.emplace_back(maker(
            [&shape, thin] { return thin ? two_wheeler_mesh(shape) : car_body_mesh(shape); }));
        prototypes_.wheels.emplace_back(
            maker([&shape, thin] { return thin ? thin_wheel_mesh(shape) : wheel_mesh(shape); }));
        prototypes_.forks.emplace_back(maker([&shape] { return fork_mesh(shape); }));
        prototypes_.cranks.emplace_back(maker([&shape] { return crank_mesh(shape); }));
    }
    for (const world::PropModel& model : world::prop_models())
        prototypes_.things.emplace_back(maker([&model] { return thing_mesh(model); }));
    prototypes_.door.emplace(maker(door_mesh));
    name_people();
}

void TownScene::add_car(std::vector<Instance>& instances,
                        const Eigen::Isometry3d& pose_world_car,
                        const Instance& body,
                        double steering,
                        std::span<const world::WheelState> wheels,
                        double roll) const {
    const world::VehicleModel& model = *prototypes_.car_shapes[body.model].model;
    Instance part = body;
    part.kind = Kind::car_body;
    part.prototype = prototypes_.car_bodies[body.model].get();
    add_instance(instances, part, pose_world_car);
    part.kind = Kind::wheel;
    part.prototype = prototypes_.wheels[body.model].get();
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
        add_instance(instances, part, pose);
    }
}

double TownScene::steering_of(const world::CarState& car) const {
    constexpr double most = 0.62;  // [rad]
    const world::VehicleModel& model = *prototypes_.car_shapes[car.model()].model;
    const double front_axle =
        static_cast<double>(car.lane_s()) - (model.length - model.rear_overhang - model.wheelbase);
    const auto heading = headings_.at(car.lane(), front_axle);
    if (!heading)
        return 0;
    const double turn =
        std::remainder(*heading - static_cast<double>(car.yaw()), 2 * std::numbers::pi);
    // Who stands across its lane, as after a crash, has let go of the wheel.
    return std::abs(turn) > 1.2 ? 0 : std::clamp(turn, -most, most);
}

void TownScene::name_people() {
    const auto part = [this](FigurePart::Shape shape, const world::WalkerModel& model) {
        return maker([shape, &model] { return figure_part_mesh(shape, model); });
    };
    const auto add = [&](const world::WalkerModel& model) {
        prototypes_.trunks.emplace_back(part(FigurePart::Shape::trunk, model));
        prototypes_.hems.emplace_back(part(FigurePart::Shape::hem, model));
    };
    for (const world::WalkerModel& model : world::walker_models())
        add(model);
    add(rider_of(world::BodyStyle::motorcycle));
    add(rider_of(world::BodyStyle::bicycle));
    const world::WalkerModel& any = world::walker_models().front();
    for (std::size_t shape = 0; shape < figure_part_shapes; ++shape)
        prototypes_.figure_parts.emplace_back(part(static_cast<FigurePart::Shape>(shape), any));
}

}  // namespace reprise::render
