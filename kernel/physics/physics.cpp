#include "kernel/physics/physics.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/bullet/convex_pair.h"
#include "kernel/physics/collisions.h"
#include "kernel/physics/door_boxes.h"
#include "kernel/physics/ground.h"
#include "kernel/physics/ground_shape.h"
#include "kernel/physics/near_cars.h"
#include "kernel/physics/near_obstacles.h"
#include "kernel/physics/props.h"
#include "kernel/physics/stance.h"
#include "kernel/physics/vehicle.h"
#include "kernel/physics/walker_hits.h"
#include "kernel/physics/wrecks.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

/// Bullet with everything said that decides results; docs/determinism.md gives the reasons.
struct Bullet {
    Bullet() : dispatcher(&configuration), world(&dispatcher, &pairs, &solver, &configuration) {
        // Process-wide values: set to Bullet's own defaults, whatever was there before.
        gContactBreakingThreshold = 0.02;
        gDeactivationTime = 2;
        gDisableDeactivation = false;
        world.setGravity(btVector3(0, 0, 0));  // vehicles bring their weight: see RaycastCar
        world.setForceUpdateAllAabbs(false);   // same results, and static bodies cost nothing
        dispatcher.registerCollisionCreateFunc(
            BOX_SHAPE_PROXYTYPE, TRIANGLE_MESH_SHAPE_PROXYTYPE, &box_on_ground);
        dispatcher.registerCollisionCreateFunc(
            TRIANGLE_MESH_SHAPE_PROXYTYPE, BOX_SHAPE_PROXYTYPE, &ground_under_box);
        for (const int other :
             {TRIANGLE_SHAPE_PROXYTYPE, CYLINDER_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE}) {
            dispatcher.registerCollisionCreateFunc(BOX_SHAPE_PROXYTYPE, other, &convex_pair);
            dispatcher.registerCollisionCreateFunc(other, BOX_SHAPE_PROXYTYPE, &convex_pair);
        }
        btDispatcherInfo& dispatch = world.getDispatchInfo();
        dispatch.m_deterministicOverlappingPairs = true;
        dispatch.m_useContinuous = false;
        btContactSolverInfo& info = world.getSolverInfo();
        info.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_SIMD;
        info.m_numIterations = 10;
        info.m_leastSquaresResidualThreshold = 0;
        info.m_minimumSolverBatchSize = 1;
        solver.reset();
    }

    btDefaultCollisionConfiguration configuration;
    BoxOnGround::Maker box_on_ground{false};
    BoxOnGround::Maker ground_under_box{true};
    ConvexPair::Maker convex_pair;
    btCollisionDispatcher dispatcher;
    btDbvtBroadphase pairs;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world;
};

/// The order in which Bullet walks over its bodies, and the numbers by which it sorts pairs of
/// them: both tell who came and went before.
void add_order(world::Hasher& hasher, const btDiscreteDynamicsWorld& world) {
    const btCollisionObjectArray& objects = world.getCollisionObjectArray();
    std::vector<int> order;
    for (int i = 0; i < objects.size(); ++i) {
        order.push_back(objects[i]->getUserIndex());
        order.push_back(objects[i]->getUserIndex2());
        order.push_back(objects[i]->getBroadphaseHandle()->getUid());
    }
    hasher.add(std::span<const int>(order));
}

/// What the solver starts from in the next substep, in the order in which it will: points, normals
/// (kept while a point lives) and impulses.
void add_manifolds(world::Hasher& hasher, btCollisionDispatcher& dispatcher) {
    const int count = dispatcher.getNumManifolds();
    hasher.add(count);
    for (int i = 0; i < count; ++i) {
        const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
        for (const btCollisionObject* body : {manifold.getBody0(), manifold.getBody1()}) {
            hasher.add(body->getUserIndex());
            hasher.add(body->getUserIndex2());
        }
        hasher.add(manifold.getNumContacts());
        for (int k = 0; k < manifold.getNumContacts(); ++k) {
            const btManifoldPoint& point = manifold.getContactPoint(k);
            add_vector(hasher, point.m_localPointA);
            add_vector(hasher, point.m_localPointB);
            add_vector(hasher, point.m_normalWorldOnB);
            hasher.add(point.m_appliedImpulse);
            hasher.add(point.m_appliedImpulseLateral1);
            hasher.add(point.m_appliedImpulseLateral2);
            hasher.add(point.m_lifeTime);
        }
    }
}

}  // namespace

struct Physics::World {
    World(const world::EpisodeT& episode,
          const Ground& its_ground,
          std::span<const world::Obstacle> standing)
        : seed(episode.seed),
          substeps(static_cast<int>(episode.substeps)),
          step(static_cast<double>(episode.step_ns) * 1e-9),
          substep(step / substeps),
          ground(its_ground),
          ground_body(ground, bullet.world),
          obstacles(standing, bullet.world),
          cars(bullet.world),
          props(bullet.world),
          collisions(episode.step_ns),
          wrecks(bullet.world, ground, step),
          doors(bullet.world) {
        REPRISE_CHECK(substeps >= 1, std::to_string(substeps) + " substeps");
    }

    std::vector<std::unique_ptr<Vehicle>>::iterator place(std::uint32_t id) {
        return std::lower_bound(
            vehicles.begin(), vehicles.end(), id, [](const auto& vehicle, std::uint32_t wanted) {
                return vehicle->id() < wanted;
            });
    }

    Vehicle& vehicle(std::uint32_t id) {
        const auto found = place(id);
        REPRISE_CHECK(found != vehicles.end() && (*found)->id() == id,
                      "vehicle " + std::to_string(id));
        return **found;
    }

    void choose_neighbours(const world::TickView& last, const world::TickDraft& next);
    void wake_props(const world::TickView& last, const world::TickDraft& next);
    void make_substep(int index, double road_friction);
    void hand_over(world::TickDraft& next) const;
    void write(world::TickT& tick);

    std::uint64_t seed;
    int substeps;
    double step;     ///< [s] a tick
    double substep;  ///< [s]
    Bullet bullet;
    const Ground& ground;
    GroundBody ground_body;
    NearObstacles obstacles;
    NearCars cars;
    WalkerHits walkers;
    Props props;
    Collisions collisions;
    Vehicles vehicles;
    Wrecks wrecks;
    DoorBoxes doors;
    CarCrashes crashes;                 ///< of the tick
    std::vector<std::uint32_t> broken;  ///< likewise, ids of the signs that broke off
    std::vector<btVector3> centres;     ///< of the vehicles, at the start of the tick
};

Physics::Physics(const world::EpisodeT& episode,
                 const SolidGround& ground,
                 std::span<const world::Obstacle> obstacles)
    : world_(std::make_unique<World>(episode, ground.in_bullet(), obstacles)) {}

Physics::~Physics() = default;

void Physics::add_vehicle(std::uint32_t id,
                          std::uint16_t model,
                          const Eigen::Isometry3d& pose_world_vehicle,
                          double speed) {
    World& w = *world_;
    const auto place = w.place(id);
    REPRISE_CHECK(place == w.vehicles.end() || (*place)->id() != id,
                  "vehicle " + std::to_string(id));
    w.vehicles.insert(
        place,
        std::make_unique<Vehicle>(id, model, w.bullet.world, w.ground, pose_world_vehicle, speed));
}

Eigen::Isometry3d Physics::stance(std::uint16_t model,
                                  const Eigen::Vector3d& p_world,
                                  double yaw) const {
    return kernel::stance(world_->ground, world::vehicle_models()[model], p_world, yaw);
}

void Physics::follow(std::uint32_t id, world::Trajectory trajectory, std::uint64_t start) {
    world_->vehicle(id).follow(std::move(trajectory), start);
}

void Physics::let_go(std::uint32_t id) {
    world_->vehicle(id).let_go();
}

void Physics::teleport(std::uint32_t id,
                       const Eigen::Isometry3d& pose_world_vehicle,
                       double speed) {
    world_->vehicle(id).teleport(pose_world_vehicle, speed);
}

void Physics::set_speed(std::uint32_t id, double speed) {
    world_->vehicle(id).set_speed(speed);
}

world::Vec3 Physics::remove_vehicle(std::uint32_t id) {
    World& w = *world_;
    const auto place = w.place(id);
    REPRISE_CHECK(place != w.vehicles.end() && (*place)->id() == id,
                  "vehicle " + std::to_string(id));
    const world::Vec3 position = (*place)->position();
    w.vehicles.erase(place);
    return position;
}

void Physics::add_prop(std::uint32_t id,
                       std::uint16_t model,
                       const Eigen::Isometry3d& pose_world_prop) {
    world_->props.add(id, model, pose_world_prop);
}

Eigen::Isometry3d Physics::prop_stance(std::uint16_t model,
                                       const Eigen::Vector3d& p_world,
                                       double yaw) const {
    const world::PropModel& prop = world::prop_models()[model];
    world::VehicleModel feet{};  // four, at its corners
    feet.wheelbase = prop.length;
    feet.track = prop.width;
    const Eigen::Vector3d ahead(std::cos(yaw), std::sin(yaw), 0);
    return kernel::stance(world_->ground, feet, p_world - ahead * (prop.length / 2), yaw) *
           Eigen::Translation3d(prop.length / 2, 0, 0);
}

bool Physics::has_prop(std::uint32_t id) const {
    return world_->props.has(id);
}

world::Vec3 Physics::remove_prop(std::uint32_t id) {
    return world_->props.remove(id);
}

void Physics::advance(const world::TickView& last, world::TickDraft& next) {
    World& w = *world_;
    w.collisions.clear();
    w.broken.clear();
    w.choose_neighbours(last, next);
    for (const auto& vehicle : w.vehicles)
        if (const world::Control* control = world::find(next.tick.controls, vehicle->id()))
            vehicle->set_control(*control);
    w.props.set_road_friction(next.tick.road_friction);
    for (const auto& vehicle : w.vehicles)
        vehicle->aim(next.tick.index, w.step);
    const bool crash = !w.crashes.empty();
    w.wrecks.begin(w.cars, w.vehicles, w.props, std::move(w.crashes));
    // Without a vehicle or a prop that moves nothing can happen.
    if (!w.vehicles.empty() || w.props.any_awake() || crash)
        for (int i = 1; i <= w.substeps; ++i)
            w.make_substep(i, next.tick.road_friction);
    for (const auto& vehicle : w.vehicles)
        if (vehicle->is_guided())
            vehicle->settle(w.step);
    w.wrecks.decide(w.collisions, w.cars, w.vehicles);
    w.write(next.tick);
    w.hand_over(next);
}

void Physics::World::choose_neighbours(const world::TickView& last, const world::TickDraft& next) {
    centres.clear();
    for (const auto& vehicle : vehicles)
        centres.push_back(vehicle->body().getCenterOfMassPosition());
    const Displaced displaced = displaced_by(next.tick.commands);
    walkers.choose(last.walkers(), next.traffic.walkers, centres, step, displaced);
    wake_props(last, next);
    props.add_centres(centres);
    crashes = crashes_among(last.cars(), next.traffic.cars, displaced);
    for (const auto& [one, other] : crashes)
        for (const std::uint32_t id : {one, other})
            centres.push_back(to_bullet(world::find(next.traffic.cars, id)->position()));
    obstacles.choose(centres);
    cars.choose(last.cars(), next.traffic.cars, centres, displaced);
    doors.choose(next, vehicles, centres);
}

/// Props that a vehicle or a car may reach in this tick are in Bullet's world.
void Physics::World::wake_props(const world::TickView& last, const world::TickDraft& next) {
    if (props.empty())
        return;
    std::vector<Props::Mover> movers;
    for (const auto& vehicle : vehicles) {
        const double speed = vehicle->body().getLinearVelocity().length();
        movers.push_back({vehicle->body().getCenterOfMassPosition(),
                          vehicle->model().catalogue->length / 2 + speed * step});
    }
    for (const world::CarState& car : next.traffic.cars) {
        const world::CarState* before = world::find(last.cars(), car.id());
        const world::VehicleModel& model = world::vehicle_models()[car.model()];
        const btVector3 here = to_bullet(car.position());
        const double way = before == nullptr ? 0 : (here - to_bullet(before->position())).length();
        if (way > 0)
            movers.push_back({here, model.length + way});
    }
    props.wake(movers);
}

void Physics::World::make_substep(int index, double road_friction) {
    const double share = static_cast<double>(index) / substeps;
    for (const auto& vehicle : vehicles) {
        if (vehicle->is_guided())
            vehicle->be_guided(share);
        else
            vehicle->drive(road_friction, substep);
    }
    const double share_before = static_cast<double>(index - 1) / substeps;
    for (Vehicle* hit : wrecks.stand_in(share_before, share, cars, vehicles, props)) {
        doors.drop(hit->id());
        hit->set_control(wreck_control(hit->id(), hit->body().getLinearVelocity().length()));
        hit->drive(road_friction, substep);
    }
    for (Vehicle* loose : wrecks.break_loose(share_before, vehicles))
        loose->drive(road_friction, substep);
    break_off(obstacles, vehicles, substep, props, collisions, broken);
    walkers.test(share, vehicles, collisions);
    cars.move(share);
    doors.move(vehicles);
    bullet.world.stepSimulation(substep, 0);  // 0: exactly one step of this length, no accumulator
    collisions.gather(bullet.dispatcher);
}

void Physics::World::write(world::TickT& tick) {
    tick.vehicles.clear();
    tick.wheels.clear();
    tick.looks.clear();
    for (const auto& vehicle : vehicles) {
        tick.vehicles.push_back(vehicle->state_after(step));
        tick.looks.push_back(world::drawn_look(seed, vehicle->id()));
        const world::Vec3& position = tick.vehicles.back().position();
        REPRISE_CHECK(std::isfinite(position.x() + position.y() + position.z()),
                      "tick " + std::to_string(tick.index) + ", vehicle " +
                          std::to_string(vehicle->id()) + " is nowhere");
        for (int i = 0; i < 4; ++i)
            tick.wheels.push_back(vehicle->wheel(i));
    }
    tick.props.clear();
    props.write(tick.props);
    const bool is_last =
        std::any_of(tick.events.begin(), tick.events.end(), [](const world::EventT& event) {
            return event.kind == world::EventKind::finished;
        });
    collisions.write(tick.index, is_last, tick.events);
}

/// Signs that broke off are props from now on, wrecks are traffic no longer.
void Physics::World::hand_over(world::TickDraft& next) const {
    for (const std::uint32_t id : broken) {
        world::EventT event;
        event.kind = world::EventKind::spawned;
        event.actor = id;
        for (const world::PropState& prop : next.tick.props)
            if (prop.id() == id)
                event.position = prop.position();
        event.text = "sign_post";
        next.tick.events.push_back(std::move(event));
    }
    for (const Wreck& wreck : wrecks.made()) {
        const world::CarState car = *world::find(next.traffic.cars, wreck.id);
        std::erase_if(next.traffic.cars, [&](const auto& one) { return one.id() == wreck.id; });
        std::erase_if(next.traffic.looks, [&](const auto& one) { return one.actor() == wreck.id; });
        world::EventT event;
        event.kind = world::EventKind::wrecked;
        event.actor = wreck.id;
        event.other = wreck.by;
        event.position = car.position();
        event.value = wreck.speed;
        event.text = fmt::format("is hit at {:.1f} m/s, and a wreck from here on", wreck.speed);
        next.tick.events.push_back(std::move(event));
    }
}

std::span<const Wreck> Physics::wrecks() const {
    return world_->wrecks.made();
}

std::span<const std::uint32_t> Physics::derailed() const {
    return world_->wrecks.derailed();
}

void Physics::nudge(std::uint32_t id, std::string_view field, std::int64_t units) {
    world_->vehicle(id).nudge(field, units);
}

std::span<const Impact> Physics::impacts() const {
    return world_->collisions.impacts();
}

std::uint64_t Physics::digest() const {
    World& w = *world_;
    world::Hasher hasher;
    hasher.add(static_cast<std::uint64_t>(w.vehicles.size()));
    for (const auto& vehicle : w.vehicles)
        vehicle->add_to(hasher);
    w.obstacles.add_to(hasher);
    w.cars.add_to(hasher);
    w.walkers.add_to(hasher);
    w.props.add_to(hasher);
    w.doors.add_to(hasher);
    w.collisions.add_to(hasher);
    add_order(hasher, w.bullet.world);
    add_manifolds(hasher, w.bullet.dispatcher);
    return hasher.digest64();
}

}  // namespace reprise::kernel
