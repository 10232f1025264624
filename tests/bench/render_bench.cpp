// An 800x600 frame of Town 1 with 100 cars, beside bare Embree: the same number of primary rays, in
// packets of 8, on the same ground, and nothing else.
#include <cmath>
#include <cstring>
#include <limits>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include "ground/mesh/build_ground.h"
#include "kernel/kernel.h"
#include "render/sensors.h"
#include "tests/bench/drive.h"
#include "world/frames.h"
#include "world/weather.h"

namespace {

using namespace reprise;

constexpr int width = 800;
constexpr int height = 600;

struct Scene {
    world::Recording recording = bench::free_drive(100);
    kernel::Kernel kernel{recording};
    const world::SealedTick* tick = nullptr;
    render::Sensors sensors{recording.town};
    render::Sensors portable{recording.town, {.threads = 0, .portable = true}};

    Scene() {
        for (int i = 0; i < 300; ++i)
            tick = &kernel.step();
    }
};

Scene& scene() {
    static Scene once;
    return once;
}

void frame(benchmark::State& state,
           world::SensorKind kind,
           const char* weather,
           render::Sensors& sensors) {
    world::SensorSpec sensor;
    sensor.name = "camera";
    sensor.kind = kind;
    sensor.width = width;
    sensor.height = height;
    const world::TickView tick = scene().tick->view();
    sensor.actor = tick.vehicles().front().id();
    for (auto _ : state)
        benchmark::DoNotOptimize(
            sensors.observe(tick, {sensor}, world::find_weather(weather)->weather));
}

void normal(benchmark::State& state, world::SensorKind kind, const char* weather) {
    frame(state, kind, weather, scene().sensors);
}

/// What the same bytes on every CPU cost.
void portable(benchmark::State& state, world::SensorKind kind, const char* weather) {
    frame(state, kind, weather, scene().portable);
}

/// Owns an Embree scene of the ground alone.
struct BareEmbree {
    RTCDevice device = rtcNewDevice("threads=1,isa=avx2");
    RTCScene ground = rtcNewScene(device);

    explicit BareEmbree(const ground::GroundMesh& mesh) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry,
                                                                     RTC_BUFFER_TYPE_VERTEX,
                                                                     0,
                                                                     RTC_FORMAT_FLOAT3,
                                                                     3 * sizeof(float),
                                                                     mesh.vertices.size()));
        for (const Eigen::Vector3d& v : mesh.vertices)
            for (int axis = 0; axis < 3; ++axis)
                *vertices++ = static_cast<float>(v[axis]);
        void* triangles = rtcSetNewGeometryBuffer(geometry,
                                                  RTC_BUFFER_TYPE_INDEX,
                                                  0,
                                                  RTC_FORMAT_UINT3,
                                                  3 * sizeof(std::uint32_t),
                                                  mesh.triangles.size());
        std::memcpy(
            triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(std::uint32_t) * 3);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(ground, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(ground);
    }

    ~BareEmbree() {
        rtcReleaseScene(ground);
        rtcReleaseDevice(device);
    }
};

void BareEmbreePrimaryRays(benchmark::State& state) {
    const BareEmbree embree(ground::build_ground(scene().recording.town));
    const world::VehicleState& ego = scene().tick->view().vehicles().front();
    const Eigen::Isometry3d pose_world_ego = world::pose(ego.position(), ego.orientation());
    const Eigen::Vector3f eye = (pose_world_ego * Eigen::Vector3d(1, 0, 1.4)).cast<float>();
    for (auto _ : state) {
        alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; column += 8) {
                RTCRayHit8 rays;
                for (int k = 0; k < 8; ++k) {
                    const double y = (width / 2.0 - column - k - 0.5) / (width / 2.0);
                    const double z = (height / 2.0 - row - 0.5) / (width / 2.0);
                    const Eigen::Vector3f d =
                        (pose_world_ego.linear() * Eigen::Vector3d(1, y, z)).cast<float>();
                    rays.ray.org_x[k] = eye.x();
                    rays.ray.org_y[k] = eye.y();
                    rays.ray.org_z[k] = eye.z();
                    rays.ray.dir_x[k] = d.x();
                    rays.ray.dir_y[k] = d.y();
                    rays.ray.dir_z[k] = d.z();
                    rays.ray.tnear[k] = 0;
                    rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
                    rays.ray.time[k] = 0;
                    rays.ray.mask[k] = ~0U;
                    rays.ray.flags[k] = 0;
                    rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
                    rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
                }
                rtcIntersect8(valid, embree.ground, &context, &rays);
                benchmark::DoNotOptimize(rays);
            }
        }
    }
}

BENCHMARK(BareEmbreePrimaryRays)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(normal, depth, world::SensorKind::depth, "clear_noon")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(portable, depth, world::SensorKind::depth, "clear_noon")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(normal, semantic, world::SensorKind::semantic, "clear_noon")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(portable, semantic, world::SensorKind::semantic, "clear_noon")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(normal, rgb_clear_noon, world::SensorKind::rgb, "clear_noon")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(portable, rgb_clear_noon, world::SensorKind::rgb, "clear_noon")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(normal, rgb_hard_rain_sunset, world::SensorKind::rgb, "hard_rain_sunset")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(portable, rgb_hard_rain_sunset, world::SensorKind::rgb, "hard_rain_sunset")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
