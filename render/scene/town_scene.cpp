// What it must do: hold the town, and the shapes of all that moves in it, as triangles that rays
// can
//   find.
// What it assumes: Debian's Embree has assertions on, so that triangles without area and rays that
//   are not numbers must never reach it.
// How it goes: one tree for each distinct mesh, and one of the town's placed meshes, built once.
//   Who moves gets a tree of its own at each tick, see scene.h: a ray looks into both.
//   Shapes of what moves are made when the first of their kind comes by.
// What it keeps: the device, the meshes, the town's instances.
#include "render/scene/town_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "world/check.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

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

/// Embree looks into the mesh itself, which must outlive it there; its last corner as well is read
/// as four floats.
void share(RTCGeometry geometry, Mesh& mesh) {
    mesh.vertices.reserve(mesh.vertices.size() + 1);
    rtcSetSharedGeometryBuffer(geometry,
                               RTC_BUFFER_TYPE_VERTEX,
                               0,
                               RTC_FORMAT_FLOAT3,
                               mesh.vertices.data(),
                               0,
                               sizeof(Eigen::Vector3f),
                               mesh.vertices.size());
    rtcSetSharedGeometryBuffer(geometry,
                               RTC_BUFFER_TYPE_INDEX,
                               0,
                               RTC_FORMAT_UINT3,
                               mesh.triangles.data(),
                               0,
                               sizeof(std::array<std::uint32_t, 3>),
                               mesh.triangles.size());
}

}  // namespace

struct TownScene::Device {
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

TownScene::TownScene(const world::TownT& town, bool portable)
    : device_(portable ? nullptr : std::make_unique<Device>()),
      origin_(whole_metres_amid(town)),
      ground_(static_cast<float>(town.low.z() - origin_.z())),
      lanes_(town, origin_),
      headings_(town) {
    name_models();
    build_town(town);
    tree_ = tree_of(instances_);
    if (portable)
        portable_tracer_.emplace(instances_);
}

TownScene::~TownScene() {
    if (!device_)
        return;
    rtcReleaseScene(tree_);
}

void ReleaseTree::operator()(RTCSceneTy* tree) const {
    rtcReleaseScene(tree);
}

const Prototype* TownScene::add_prototype(Mesh mesh) {
    return &meshes_.emplace_back(make_prototype(std::move(mesh)));
}

Prototype TownScene::make_prototype(Mesh mesh) const {
    Prototype prototype{std::move(mesh), nullptr, nullptr};
    double squared = 0;
    for (const Eigen::Vector3f& vertex : prototype.mesh.vertices)
        squared = std::max(squared, vertex.cast<double>().squaredNorm());
    prototype.radius = std::sqrt(squared);
    if (!device_) {
        prototype.plain_tree = std::make_unique<MeshTree>(prototype.mesh);
        return prototype;
    }
    RTCScene tree = rtcNewScene(device_->handle);
    prototype.tree.reset(tree);
    rtcSetSceneBuildQuality(tree, RTC_BUILD_QUALITY_MEDIUM);
    // Watertight: else some rays in a picture slip through between two triangles of the ground.
    rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
    if (!prototype.mesh.triangles.empty()) {
        RTCGeometry geometry = rtcNewGeometry(device_->handle, RTC_GEOMETRY_TYPE_TRIANGLE);
        share(geometry, prototype.mesh);
        // Rays choose by the instance; everything inside one is visible to all.
        rtcSetGeometryMask(geometry, 0xffffffffu);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(tree, geometry);
        rtcReleaseGeometry(geometry);
    }
    // Who waits here must not begin with another's work, which may ask for the same prototype.
    tbb::this_task_arena::isolate([&] { rtcCommitScene(tree); });
    return prototype;
}

void TownScene::add_instance(std::vector<Instance>& instances,
                             const Instance& instance,
                             const Eigen::Affine3d& pose_world) const {
    Instance& placed = instances.emplace_back(instance);
    placed.pose = pose_world;
    placed.pose.translation() -= origin_;
    placed.moved = placed.pose.matrix() != Eigen::Matrix4d::Identity();
    placed.normal_to_scene = pose_world.linear().inverse().transpose().cast<float>();
}

void set_pose(RTCGeometryTy* geometry, const Instance& instance) {
    const Eigen::Affine3f pose = instance.pose.cast<float>();
    const Eigen::Matrix<float, 3, 4> columns = pose.matrix().topRows<3>();
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
}

void TownScene::check() const {
    device_->check();
}

RTCSceneTy* TownScene::new_tree() const {
    RTCScene tree = rtcNewScene(device_->handle);
    rtcSetSceneBuildQuality(tree, RTC_BUILD_QUALITY_MEDIUM);
    return tree;
}

void TownScene::attach(RTCSceneTy* tree, const Instance& instance, unsigned id) const {
    RTCGeometry geometry = rtcNewGeometry(device_->handle, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, instance.prototype->tree.get());
    set_pose(geometry, instance);
    rtcSetGeometryMask(geometry, instance.mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree, geometry, id);
    rtcReleaseGeometry(geometry);
}

RTCSceneTy* TownScene::tree_of(std::span<const Instance> instances) const {
    if (!device_)
        return nullptr;
    RTCScene tree = new_tree();
    for (std::size_t i = 0; i < instances.size(); ++i)
        attach(tree, instances[i], static_cast<unsigned>(i));
    rtcCommitScene(tree);
    check();
    return tree;
}

}  // namespace reprise::render
