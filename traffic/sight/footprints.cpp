#include "traffic/sight/footprints.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/doors.h"
#include "world/models/prop_models.h"

namespace reprise::traffic {

namespace {

constexpr double longest_piece = 2.5;      // [m]
constexpr double least_prop_height = 0.2;  // [m] what is lower passes below a car
constexpr double far_aside = 0.6;          // [m] from where SUMO believes a car
constexpr double beside_walkers = 0.4;     // [m]
constexpr double beside_things = 0.1;      // [m]

/// In pieces of equal length.
void add_pieces(const Footprint& whole, std::vector<Footprint>& footprints) {
    const int count =
        std::max(1, static_cast<int>(std::ceil(2 * whole.half_length / longest_piece)));
    Footprint piece = whole;
    piece.half_length = whole.half_length / count;
    for (int i = 0; i < count; ++i) {
        const double along = (2 * i + 1 - count) * piece.half_length;
        piece.centre = whole.centre + along * whole.direction;
        footprints.push_back(piece);
    }
}

void add_car(std::uint32_t id,
             std::uint16_t model_index,
             const Eigen::Vector3d& rear,
             const Eigen::Vector2d& direction,
             const Eigen::Vector2d& velocity,
             bool drives,
             std::vector<Footprint>& footprints) {
    const world::VehicleModel& model = world::vehicle_models()[model_index];
    Footprint body;
    body.half_length = model.length / 2;
    body.half_width = model.width / 2;
    body.direction = direction;
    body.centre = rear.head<2>() + (body.half_length - model.rear_overhang) * direction;
    body.z = rear.z();
    body.velocity = velocity;
    body.clearance = beside_things;
    body.drives = drives;
    body.id = id;
    add_pieces(body, footprints);
}

/// A circle is a box as wide as it is long; who lies is as long as tall.
void add_walkers(std::span<const world::WalkerState> walkers, std::vector<Footprint>& footprints) {
    for (const world::WalkerState& walker : walkers) {
        const world::WalkerModel& model = world::walker_models()[walker.model()];
        Footprint body;
        body.direction = world::ahead_of(static_cast<double>(walker.yaw()));
        body.centre = {walker.position().x(), walker.position().y()};
        body.z = walker.position().z();
        body.half_width = model.shoulder_width / 2;
        body.half_length = walker.down() ? model.height / 2 : body.half_width;
        body.velocity = static_cast<double>(walker.speed()) * body.direction;
        body.clearance = beside_walkers;
        body.is_afoot = !walker.down() && walker.id() >= world::first_background_id;
        body.id = walker.id();
        footprints.push_back(body);
    }
}

void add_props(std::span<const world::PropState> props, std::vector<Footprint>& footprints) {
    for (const world::PropState& prop : props) {
        const world::PropModel& model = world::prop_models()[prop.model()];
        if (model.height < least_prop_height)
            continue;
        Footprint body;
        body.direction = world::level_direction(prop.orientation());
        body.centre = {prop.position().x(), prop.position().y()};
        body.z = prop.position().z();
        body.half_length = model.length / 2;
        body.half_width = model.width / 2;
        body.velocity = {prop.velocity().x(), prop.velocity().y()};
        body.clearance = beside_things;
        body.id = prop.id();
        add_pieces(body, footprints);
    }
}

void add_doors(const world::TickView& last, std::vector<Footprint>& footprints) {
    for (const world::Door& door : last.doors()) {
        const world::VehicleState* vehicle = world::find(last.vehicles(), door.actor());
        const world::CarState* car = world::find(last.cars(), door.actor());
        if (vehicle == nullptr && car == nullptr)
            continue;
        const std::uint16_t model = vehicle != nullptr ? vehicle->model() : car->model();
        const Eigen::Isometry3d pose =
            vehicle != nullptr ? world::pose(vehicle->position(), vehicle->orientation())
                               : world::pose(car->position(),
                                             static_cast<double>(car->yaw()),
                                             static_cast<double>(car->pitch()));
        const world::DoorLeaf leaf =
            world::door_leaf(world::vehicle_models()[model], pose, door.door(), door.angle());
        Footprint body;
        body.direction = leaf.pose.linear().col(0).head<2>().normalized();
        body.centre = leaf.pose.translation().head<2>();
        body.z = pose.translation().z();
        body.half_length = leaf.half.x();
        body.half_width = leaf.half.y();
        body.velocity.setZero();
        body.clearance = beside_things;
        body.id = door.actor();
        footprints.push_back(body);
    }
}

}  // namespace

void gather_footprints(const world::TickView& last,
                       std::span<const Car> cars,
                       std::vector<Footprint>& footprints) {
    footprints.clear();
    for (const world::VehicleState& vehicle : last.vehicles())
        add_car(vehicle.id(),
                vehicle.model(),
                world::to_eigen(vehicle.position()),
                world::level_direction(vehicle.orientation()),
                {vehicle.velocity().x(), vehicle.velocity().y()},
                vehicle.id() < world::first_background_id,  // else a wreck
                footprints);
    // SUMO believes them elsewhere: by order, or where it cut a change of lanes short.
    const auto is_aside = [](const Car& car) {
        // Its tail is still, where its bumper is back already.
        const bool passes = car.origin == Origin::demand && car.offset_order && !car.leans;
        return passes || std::abs(car.offset) > far_aside ||
               std::abs(world::cross(car.ahead, car.slip)) > far_aside;
    };
    for (const Car& car : cars) {
        const std::size_t before = footprints.size();
        if (car.origin == Origin::parked || car.sumo.empty() || car.boxed_in || is_aside(car))
            add_car(car.id,
                    car.model,
                    car.rear,
                    car.ahead,
                    car.speed * car.ahead,
                    car.origin != Origin::parked,
                    footprints);
        for (std::size_t i = before; i < footprints.size(); ++i)
            footprints[i].boxed_in = car.boxed_in;
    }
    add_walkers(last.walkers(), footprints);
    add_props(last.props(), footprints);
    add_doors(last, footprints);
}

}  // namespace reprise::traffic
