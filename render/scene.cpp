// What it must do: hold the town and everybody in it as triangles that rays can find.
// What it assumes: ticks are sorted by id; Debian's Embree has assertions on, so that triangles
//   without area and rays that are not numbers must never reach it.
// How it goes: one tree for each distinct mesh, built once; a tree of placed meshes, built anew for
//   every tick (history-free, and cheaper than refitting).
// What it keeps: the device, the meshes, the town's own instances.
#include "render/scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tbb/parallel_for.h>

#include <embree3/rtcore.h>

#include "render/figure.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/ground.h"
#include "world/town.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

constexpr std::uint32_t first_mount_bit = 2;
constexpr std::size_t mount_bits = 30;
constexpr double skirt = 2000;  // [m] of grass around the town, up to the horizon

/// Pictures depend on the instruction set in the last bits: always the same one on one machine.
const char* device_settings() {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0)
        return "isa=avx2";
    return __builtin_cpu_supports("sse4.2") != 0 ? "isa=sse4.2" : "isa=sse2";
}

Vector3d whole_metres_amid(const world::TownT& town) {
    const auto middle = [](double low, double high) { return std::floor((low + high) / 2); };
    return {middle(town.low.x(), town.high.x()),
            middle(town.low.y(), town.high.y()),
            middle(town.low.z(), town.high.z())};
}

Material ground_material(world::Surface surface) {
    switch (surface) {
        case world::Surface::terrain:
            return Material::grass;
        case world::Surface::sidewalk:
            return Material::pavement;
        case world::Surface::kerb:
            return Material::kerb;
        case world::Surface::marking:
            return Material::marking;
        default:
            return Material::asphalt;
    }
}

Mesh mesh_of(const world::GroundMesh& ground, const Vector3d& origin) {
    Mesh mesh;
    for (const Vector3d& vertex : ground.vertices)
        mesh.vertices.emplace_back((vertex - origin).cast<float>());
    mesh.triangles = ground.triangles;
    for (const world::Surface surface : ground.surfaces)
        mesh.materials.push_back(ground_material(surface));
    mesh.tags.assign(mesh.triangles.size(), 0);
    drop_degenerate(mesh);
    return mesh;
}

/// Grass from the town's border to the horizon, below everything else.
void add_skirt(Mesh& mesh, const world::TownT& town, const Vector3d& origin) {
    const auto z = static_cast<float>(town.low.z() - origin.z() - 0.35);
    const auto west = static_cast<float>(town.low.x() - origin.x() - skirt);
    const auto east = static_cast<float>(town.high.x() - origin.x() + skirt);
    const auto south = static_cast<float>(town.low.y() - origin.y() - skirt);
    const auto north = static_cast<float>(town.high.y() - origin.y() + skirt);
    add_quad(mesh,
             {Eigen::Vector3f(west, south, z),
              Eigen::Vector3f(east, south, z),
              Eigen::Vector3f(east, north, z),
              Eigen::Vector3f(west, north, z)},
             {Material::grass});
}

double mean_length(std::span<const world::WheelState> wheels) {
    double sum = 0;
    for (const world::WheelState& wheel : wheels)
        sum += wheel.suspension_length();
    return sum / static_cast<double>(wheels.size());
}

BuildingFrame frame_of(const world::Building& building, const Vector3d& origin) {
    return {(world::to_eigen(building.centre()) - origin).cast<float>(),
            static_cast<float>(std::cos(building.yaw())),
            static_cast<float>(std::sin(building.yaw())),
            {static_cast<float>(building.length() / 2), static_cast<float>(building.width() / 2)},
            Facade(building)};
}

}  // namespace

struct Scene::Device {
    Device() {
        // Embree must not be the first to use TBB in this process: workers that it starts keep its
        // floating-point mode (flush to zero) for everybody else's loops.
        tbb::parallel_for(0, 64, [](int) {});
        handle = rtcNewDevice(device_settings());
        REPRISE_CHECK(handle != nullptr, "Embree: no device");
    }

    ~Device() { rtcReleaseDevice(handle); }

    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    void check() const {
        const RTCError error = rtcGetDeviceError(handle);
        REPRISE_CHECK(error == RTC_ERROR_NONE, "Embree error " + std::to_string(error));
    }

    RTCDevice handle = nullptr;
};

Scene::Scene(const world::TownT& town)
    : device_(std::make_unique<Device>()),
      origin_(whole_metres_amid(town)),
      lanes_(town, origin_) {
    build_town(town);
    build_models();
    device_->check();
}

Scene::~Scene() {
    rtcReleaseScene(top_);
    for (const Prototype& prototype : prototypes_)
        rtcReleaseScene(prototype.tree);
}

const Prototype* Scene::add_prototype(Mesh mesh) {
    Prototype& prototype = prototypes_.emplace_back(Prototype{std::move(mesh), nullptr});
    prototype.tree = rtcNewScene(device_->handle);
    rtcSetSceneBuildQuality(prototype.tree, RTC_BUILD_QUALITY_MEDIUM);
    if (!prototype.mesh.triangles.empty()) {
        RTCGeometry geometry = rtcNewGeometry(device_->handle, RTC_GEOMETRY_TYPE_TRIANGLE);
        const std::size_t vertices = prototype.mesh.vertices.size();
        const std::size_t triangles = prototype.mesh.triangles.size();
        auto* positions =
            static_cast<Eigen::Vector3f*>(rtcSetNewGeometryBuffer(geometry,
                                                                  RTC_BUFFER_TYPE_VERTEX,
                                                                  0,
                                                                  RTC_FORMAT_FLOAT3,
                                                                  sizeof(Eigen::Vector3f),
                                                                  vertices));
        std::copy(prototype.mesh.vertices.begin(), prototype.mesh.vertices.end(), positions);
        using Corners = std::array<std::uint32_t, 3>;
        auto* corners = static_cast<Corners*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Corners), triangles));
        std::copy(prototype.mesh.triangles.begin(), prototype.mesh.triangles.end(), corners);
        // Rays choose by the instance; everything inside one is visible to all.
        rtcSetGeometryMask(geometry, 0xffffffffu);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(prototype.tree, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(prototype.tree);
    return &prototype;
}

void Scene::build_town(const world::TownT& town) {
    const auto add = [&](Mesh mesh, Kind kind, std::uint32_t mask) {
        Instance& instance = town_.emplace_back();
        instance.prototype = add_prototype(std::move(mesh));
        instance.kind = kind;
        instance.mask = mask;
    };
    Mesh ground = mesh_of(world::build_ground(town), origin_);
    add_skirt(ground, town, origin_);
    add(std::move(ground), Kind::ground, solid_bit);
    Mesh markings = mesh_of(world::build_markings(town), origin_);
    if (!markings.triangles.empty())
        add(std::move(markings), Kind::marking, marking_bit);

    Mesh houses;
    for (std::uint32_t i = 0; i < town.buildings.size(); ++i) {
        add_building(houses, town.buildings[i], i, origin_);
        buildings_.push_back(frame_of(town.buildings[i], origin_));
    }
    add_signals(houses, town, origin_);
    drop_degenerate(houses);
    if (!houses.triangles.empty())
        add(std::move(houses), Kind::town, solid_bit);

    std::vector<const Prototype*> kinds;
    for (std::uint32_t kind = 0; kind < tree_kinds && !town.trees.empty(); ++kind)
        kinds.push_back(add_prototype(tree_mesh(kind)));
    for (const world::Tree& tree : town.trees) {
        Instance instance;
        instance.kind = Kind::tree;
        instance.prototype = kinds[tree.style() % tree_kinds];
        instance.model = static_cast<std::uint16_t>(tree.style() & 0xffffu);
        const double turn = static_cast<double>(tree.style() % 360) * 0.0174533;
        Eigen::Affine3d pose(Eigen::Translation3d(world::to_eigen(tree.position())));
        pose.rotate(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
        pose.scale(Vector3d(tree.crown_radius(), tree.crown_radius(), tree.height()));
        add_instance(instance, pose);
    }
    town_.insert(town_.end(), instances_.begin(), instances_.end());
    instances_.clear();
}

void Scene::build_models() {
    for (const world::VehicleModel& model : world::vehicle_models()) {
        car_shapes_.emplace_back(model);
        car_bodies_.push_back(add_prototype(car_body_mesh(car_shapes_.back())));
        wheels_.push_back(add_prototype(wheel_mesh(car_shapes_.back())));
    }
    ball_ = add_prototype(ball_mesh());
    bone_ = add_prototype(bone_mesh());
}

void Scene::add_instance(Instance instance, const Eigen::Affine3d& pose_world) {
    instance.pose = pose_world;
    instance.pose.translation() -= origin_;
    instance.normal_to_scene = pose_world.linear().inverse().transpose().cast<float>();
    if (instance.actor != 0) {
        const auto mount = std::find(mounts_.begin(), mounts_.end(), instance.actor);
        if (mount != mounts_.end())
            instance.mask = ~mask_hiding(instance.actor);
    }
    instances_.push_back(instance);
}

std::uint32_t Scene::mask_hiding(std::uint32_t actor) const {
    const auto mount = std::find(mounts_.begin(), mounts_.end(), actor);
    if (actor == 0 || mount == mounts_.end())
        return 0xffffffffu;
    const auto index = static_cast<std::size_t>(mount - mounts_.begin()) % mount_bits;
    return ~(1u << (first_mount_bit + index));
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
            pose.rotate(Eigen::AngleAxisd(M_PI, Vector3d::UnitZ()));
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

void Scene::commit() {
    if (top_ != nullptr)
        rtcReleaseScene(top_);
    top_ = rtcNewScene(device_->handle);
    rtcSetSceneBuildQuality(top_, RTC_BUILD_QUALITY_MEDIUM);
    for (const Instance& instance : instances_) {
        RTCGeometry geometry = rtcNewGeometry(device_->handle, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, instance.prototype->tree);
        const Eigen::Affine3f pose = instance.pose.cast<float>();
        Eigen::Matrix<float, 3, 4> columns = pose.matrix().topRows<3>();
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
        rtcSetGeometryMask(geometry, instance.mask);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(top_, geometry);  // ids count up from 0: an id is the index here
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(top_);
    device_->check();
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
