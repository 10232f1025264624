#include "render/sensors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "render/scene/scene.h"
#include "render/shade/frame.h"
#include "render/trace/default_float_mode.h"
#include "world/check.h"
#include "world/models/viewpoint.h"

namespace reprise::render {

/// What is kept between calls: the town, the sky of the last weather, and memory for pictures.
struct Sensors::Scene {
    Scene(const world::TownT& town, const Options& options) {
        REPRISE_CHECK(options.threads >= 0, std::to_string(options.threads) + " threads");
        if (options.threads > 0) {
            const auto threads = static_cast<std::size_t>(options.threads);
            limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
            arena.initialize(options.threads);
        }
        arena.execute([&] {
            const DefaultFloatMode plain;
            still.emplace(town, options.portable);
            scene.emplace(*still);
        });
    }

    std::vector<world::SensorFrame> observe(const world::TickView& tick,
                                            const world::SensorRig& rig,
                                            const world::Weather& weather);

    const Sky& sky_of(const world::Weather& weather) {
        if (!sky || !(sky->weather() == weather))
            sky.emplace(weather);
        return *sky;
    }

    // The limit also binds Embree, which has an arena of its own, and allows more threads than
    // cores.
    std::optional<tbb::global_control> limit;
    tbb::task_arena arena;
    std::optional<TownScene> still;
    std::optional<render::Scene> scene;
    std::optional<Sky> sky;
    Frame frame;
};

namespace {

Camera camera_of(const world::TickView& tick,
                 const world::SensorSpec& spec,
                 const Eigen::Vector3d& origin) {
    if (spec.width <= 0 || spec.height <= 0 || !(spec.fov > 0.001 && spec.fov < 3.1) ||
        !spec.position.allFinite() || !std::isfinite(spec.yaw) || !std::isfinite(spec.pitch))
        throw world::Error("sensor '" + spec.name +
                           "': size, field of view or place is not possible");
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    if (spec.actor != 0) {
        const std::optional<Eigen::Isometry3d> found = world::find_pose(tick, spec.actor);
        if (!found)
            throw world::Error("sensor '" + spec.name + "': there is no actor " +
                               std::to_string(spec.actor) + " at tick " +
                               std::to_string(tick.index()));
        pose = *found;
    }
    pose.translation() -= origin;
    return {spec, pose};
}

/// Who is out of sight for a camera: the actor that it is fixed to. 0: nobody.
std::uint32_t hidden_from(const world::TickView& tick, const world::SensorSpec& spec) {
    const std::optional<world::Extent> extent = world::find_extent(tick, spec.actor);
    return extent && world::is_carried_at(*extent, spec.position) ? spec.actor : 0;
}

world::SensorFrame empty_frame(const world::TickView& tick, const world::SensorSpec& spec) {
    world::SensorFrame frame;
    frame.name = spec.name;
    frame.kind = spec.kind;
    frame.tick = tick.index();
    frame.width = spec.width;
    frame.height = spec.height;
    frame.channels = spec.kind == world::SensorKind::rgb ? 3 : 1;
    frame.type =
        spec.kind == world::SensorKind::depth ? world::PixelType::f32 : world::PixelType::u8;
    return frame;
}

std::vector<std::uint8_t> depth_bytes(const std::vector<Hit>& hits) {
    std::vector<std::uint8_t> bytes(hits.size() * sizeof(float));
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const float depth = hits[i].instance == no_instance ? std::numeric_limits<float>::infinity()
                                                            : hits[i].distance;
        std::memcpy(bytes.data() + i * sizeof(float), &depth, sizeof(float));
    }
    return bytes;
}

std::vector<std::uint8_t> class_bytes(const Scene& scene, const std::vector<Hit>& hits) {
    std::vector<std::uint8_t> bytes(hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i)
        bytes[i] = static_cast<std::uint8_t>(semantic_class(scene, hits[i]));
    return bytes;
}

}  // namespace

Sensors::Sensors(const world::TownT& town, const Options& options)
    : scene_(std::make_unique<Scene>(town, options)) {}

Sensors::~Sensors() = default;

std::vector<world::SensorFrame> Sensors::observe(const world::TickView& tick,
                                                 const world::SensorRig& rig,
                                                 const world::Weather& weather) {
    return scene_->arena.execute([&] { return scene_->observe(tick, rig, weather); });
}

std::vector<world::SensorFrame> Sensors::Scene::observe(const world::TickView& tick,
                                                        const world::SensorRig& rig,
                                                        const world::Weather& weather) {
    const DefaultFloatMode plain;
    render::Scene& placed = *scene;
    // From where cameras look, and who carries them out of their sight.
    std::vector<std::uint32_t> mounts;
    std::vector<Camera> cameras;
    for (const world::SensorSpec& spec : rig) {
        cameras.push_back(camera_of(tick, spec, placed.origin()));
        const std::uint32_t hidden = hidden_from(tick, spec);
        if (hidden != 0 && std::find(mounts.begin(), mounts.end(), hidden) == mounts.end())
            mounts.push_back(hidden);
    }
    placed.place(tick, mounts);

    // Sensors of one place look once, together.
    std::vector<world::SensorFrame> frames(rig.size());
    std::vector<bool> done(rig.size(), false);
    std::vector<Hit> hits;
    for (std::size_t first = 0; first < rig.size(); ++first) {
        if (done[first])
            continue;
        const std::uint32_t mask = placed.mask_hiding(hidden_from(tick, rig[first]));
        trace_primary(placed, cameras[first], mask, hits);
        for (std::size_t i = first; i < rig.size(); ++i) {
            if (done[i] || rig[i].actor != rig[first].actor || !(cameras[i] == cameras[first]))
                continue;
            done[i] = true;
            frames[i] = empty_frame(tick, rig[i]);
            switch (rig[i].kind) {
                case world::SensorKind::depth:
                    frames[i].data = depth_bytes(hits);
                    break;
                case world::SensorKind::semantic:
                    frames[i].data = class_bytes(placed, hits);
                    break;
                case world::SensorKind::rgb: {
                    const ShadingInput input{placed, sky_of(weather), tick.index()};
                    shade(input, cameras[i], mask, hits, frame);
                    draw_rain(input, cameras[i], hits, frame);
                    frames[i].data = tone_map(frame, tick.index());
                    break;
                }
            }
        }
    }
    return frames;
}

}  // namespace reprise::render
