#include "tests/kernel/physics/physics_rig.h"

#include <cmath>

#include "ground/obstacles.h"
#include "tests/support/worlds.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::test {

namespace {

constexpr double reach = 2000;

void add_quad(ground::GroundMesh& mesh,
              const std::array<Eigen::Vector3d, 4>& corners,
              ground::Surface surface) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.surfaces.insert(mesh.surfaces.end(), 2, surface);
}

}  // namespace

ground::GroundMesh inclined_ground(double slope) {
    ground::GroundMesh mesh;
    const double rise = slope * reach;
    add_quad(mesh,
             {Eigen::Vector3d(-reach, -reach, -rise),
              {reach, -reach, rise},
              {reach, reach, rise},
              {-reach, reach, -rise}},
             ground::Surface::road);
    return mesh;
}

ground::GroundMesh flat_ground() {
    return inclined_ground(0);
}

ground::GroundMesh kerb_ground(double x, double height) {
    ground::GroundMesh mesh;
    add_quad(
        mesh,
        {Eigen::Vector3d(-reach, -reach, 0), {x, -reach, 0}, {x, reach, 0}, {-reach, reach, 0}},
        ground::Surface::road);
    add_quad(
        mesh,
        {Eigen::Vector3d(x, -reach, 0), {x, -reach, height}, {x, reach, height}, {x, reach, 0}},
        ground::Surface::kerb);
    add_quad(mesh,
             {Eigen::Vector3d(x, -reach, height),
              {reach, -reach, height},
              {reach, reach, height},
              {x, reach, height}},
             ground::Surface::sidewalk);
    return mesh;
}

world::Control coasting(std::uint32_t actor) {
    return {0, 0, 0, actor, 0, false, false};
}

world::Control drive(double throttle, double brake, double steer) {
    return {throttle, brake, steer, 1, 0, false, false};
}

ProvingGround::ProvingGround(const ground::GroundMesh& ground, const world::TownT& town)
    : episode_(episode()),
      ground_(ground),
      physics_(episode_, ground_, ground::obstacles_of(town)) {}

void ProvingGround::add_vehicle(const char* model, double speed, double x, double y, double yaw) {
    physics_.add_vehicle(
        1, world::find_vehicle_model(model).value(), world::pose({x, y, 0}, yaw, 0), speed);
}

const world::VehicleState& ProvingGround::step(const world::Control& control) {
    world::TickDraft next;
    next.tick.index = next_.tick.index + 1;
    next.tick.road_friction = road_friction;
    next.tick.controls = {control};
    // As the traffic stage: who has become a vehicle is none of its cars.
    std::erase_if(cars, [&](const world::CarState& car) {
        return world::find(next_.tick.vehicles, car.id()) != nullptr;
    });
    next.traffic.cars = cars;
    next.traffic.walkers = walkers;
    last_.emplace(world::seal(next_, {}));
    physics_.advance(last_->view(), next);
    next_ = std::move(next);
    return vehicle();
}

double speed_of(const world::VehicleState& vehicle) {
    const Eigen::Vector3d ahead = world::to_eigen(vehicle.orientation()) * Eigen::Vector3d::UnitX();
    return ahead.dot(world::to_eigen(vehicle.velocity()));
}

double distance_to_stop(ProvingGround& ground, const world::Control& control) {
    const double start = ground.step(control).odometer();
    const double first_tick = start;  // the odometer counts from the spawn
    for (int tick = 0; tick < 4000 && speed_of(ground.vehicle()) > 0.01; ++tick)
        ground.step(control);
    return ground.vehicle().odometer() - start + first_tick;
}

}  // namespace reprise::test
