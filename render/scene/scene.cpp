// What it must do: hold the town and everybody in it as triangles that rays can find.
// What it assumes: ticks are sorted by id; Debian's Embree has assertions on, so that triangles
//   without area and rays that are not numbers must never reach it.
// How it goes: one tree for each distinct mesh, built once; a tree of placed meshes, built anew for
//   every tick (history-free, and cheaper than refitting).
// What it keeps: the device, the meshes, the town's own instances.
#include "render/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include "world/check.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

constexpr std::uint32_t first_mount_bit = 2;
constexpr std::size_t mount_bits = 30;

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

Scene::Scene(const world::TownT& town, bool portable)
    : device_(portable ? nullptr : std::make_unique<Device>()),
      origin_(whole_metres_amid(town)),
      lanes_(town, origin_) {
    build_models();
    build_town(town);
    if (device_)
        device_->check();
}

Scene::~Scene() {
    if (!device_)
        return;
    rtcReleaseScene(top_);
    for (const Prototype& prototype : prototypes_)
        rtcReleaseScene(prototype.tree);
}

const Prototype* Scene::add_prototype(Mesh mesh) {
    Prototype& prototype = prototypes_.emplace_back(Prototype{std::move(mesh), nullptr, nullptr});
    if (!device_) {
        prototype.plain_tree = std::make_unique<MeshTree>(prototype.mesh);
        return &prototype;
    }
    prototype.tree = rtcNewScene(device_->handle);
    rtcSetSceneBuildQuality(prototype.tree, RTC_BUILD_QUALITY_MEDIUM);
    // Watertight: else some rays in a picture slip through between two triangles of the ground.
    rtcSetSceneFlags(prototype.tree, RTC_SCENE_FLAG_ROBUST);
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

void Scene::commit() {
    if (!device_) {
        portable_tracer_.emplace(instances_);
        return;
    }
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

}  // namespace reprise::render
