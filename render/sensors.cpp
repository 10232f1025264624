#include "render/sensors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <tbb/parallel_for.h>

#include "render/frame.h"
#include "render/scene.h"
#include "world/check.h"

namespace reprise::render {

/// What is kept between calls: the town, the sky of the last weather, and memory for pictures.
struct Sensors::Scene {
    explicit Scene(const world::TownT& town) : scene(town) {}

    const Sky& sky_of(const world::Weather& weather) {
        if (!sky || !(sky->weather() == weather))
            sky.emplace(weather);
        return *sky;
    }

    render::Scene scene;
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
        const std::optional<Eigen::Isometry3d> found = Scene::find_actor(tick, spec.actor);
        if (!found)
            throw world::Error("sensor '" + spec.name + "': there is no actor " +
                               std::to_string(spec.actor) + " at tick " +
                               std::to_string(tick.index()));
        pose = *found;
    }
    pose.translation() -= origin;
    return {spec, pose};
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

Sensors::Sensors(const world::TownT& town) : scene_(std::make_unique<Scene>(town)) {}

Sensors::~Sensors() = default;

std::vector<world::SensorFrame> Sensors::observe(const world::TickView& tick,
                                                 const world::SensorRig& rig,
                                                 const world::Weather& weather) {
    render::Scene& scene = scene_->scene;
    // Who carries cameras, and from where they look.
    std::vector<std::uint32_t> mounts;
    std::vector<Camera> cameras;
    for (const world::SensorSpec& spec : rig) {
        cameras.push_back(camera_of(tick, spec, scene.origin()));
        if (spec.actor != 0 && std::find(mounts.begin(), mounts.end(), spec.actor) == mounts.end())
            mounts.push_back(spec.actor);
    }
    scene.place(tick, mounts);

    // Sensors of one place look once, together.
    std::vector<world::SensorFrame> frames(rig.size());
    std::vector<bool> done(rig.size(), false);
    std::vector<Hit> hits;
    for (std::size_t first = 0; first < rig.size(); ++first) {
        if (done[first])
            continue;
        const std::uint32_t mask = scene.mask_hiding(rig[first].actor);
        see(scene, cameras[first], mask, hits);
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
                    frames[i].data = class_bytes(scene, hits);
                    break;
                case world::SensorKind::rgb: {
                    const Stage stage{scene, scene_->sky_of(weather), tick.index()};
                    shade(stage, cameras[i], mask, hits, scene_->frame);
                    draw_rain(stage, cameras[i], hits, scene_->frame);
                    frames[i].data = develop(scene_->frame, tick.index());
                    break;
                }
            }
        }
    }
    return frames;
}

}  // namespace reprise::render
