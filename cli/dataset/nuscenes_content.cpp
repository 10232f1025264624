#include "cli/dataset/nuscenes_content.h"

#include "cli/dataset/nuscenes_points.h"
#include "cli/pictures/manifest.h"
#include "render/trace/camera.h"
#include "world/external/mounting.h"

namespace reprise::cli {

namespace {

std::vector<NuscenesChannel> channels_of(const DatasetLayout& layout) {
    std::vector<NuscenesChannel> channels;
    for (std::size_t i = 0; i < layout.cameras().size(); ++i) {
        if (!layout.is_rgb(i))
            continue;
        const render::Camera eye(layout.cameras()[i], Eigen::Isometry3d::Identity());
        NuscenesChannel& one = channels.emplace_back();
        one.name = layout.camera_channel(i);
        one.modality = "camera";
        one.camera = true;
        one.number = i;
        one.pose_ego = Eigen::Isometry3d::Identity();
        one.pose_ego.translation() = eye.position();
        one.pose_ego.linear() = eye.rotation_scene_camera();
        one.intrinsic << eye.focal(), 0, eye.middle().x(), 0, eye.focal_y(), eye.middle().y(), 0, 0,
            1;
    }
    for (std::size_t i = 0; i < layout.rays().size(); ++i) {
        if (!layout.is_weathered(i))
            continue;
        const bool radar = layout.rays()[i].kind == world::SensorKind::radar;
        NuscenesChannel& one = channels.emplace_back();
        one.name = layout.ray_channel(i);
        one.modality = radar ? "radar" : "lidar";
        one.number = i;
        one.pose_ego = world::pose_in_mount(layout.rays()[i]);
        if (!radar)
            one.pose_ego = one.pose_ego * pose_sensor_nuscenes_lidar();
    }
    return channels;
}

}  // namespace

NuscenesContent::NuscenesContent(const DatasetLayout& dataset,
                                 const std::list<DatasetSource>& sources,
                                 const std::vector<DatasetFrame>& dataset_frames)
    : layout(dataset),
      channels(channels_of(dataset)),
      maps(nuscenes_maps(sources, dataset_frames)),
      frames(nuscenes_frames(dataset, sources, dataset_frames)) {
    for (const DatasetSource& source : sources) {
        const world::EpisodeT& episode = source.trace().episode();
        logs.push_back({chain_text(source.trace()),
                        episode.name,
                        episode.town,
                        episode.seed,
                        episode.step_ns,
                        episode.weather_name,
                        map_of(maps, logs.size()).origin()});
    }
    for (std::size_t id = 0; id < frames.size(); ++id) {
        if (id == 0 || frames[id - 1].trace != frames[id].trace ||
            frames[id - 1].split != frames[id].split)
            scenes.push_back(id);
        scene_of.push_back(scenes.size() - 1);
        for (const NuscenesSweep& sweep : frames[id].sweeps)
            moments.emplace_back(id, sweep.before);
        moments.emplace_back(id);
    }
}

std::uint64_t NuscenesContent::time(const Moment& moment) const {
    constexpr std::uint64_t day = 86'400'000'000;
    const NuscenesFrame& frame = frames[moment.id];
    const std::uint64_t tick = frame.tick - moment.before;
    return (frame.trace + 1) * day + tick * logs[frame.trace].step_ns / 1000;
}

const Eigen::Isometry3d& NuscenesContent::pose_world_ego(const Moment& moment) const {
    const NuscenesFrame& frame = frames[moment.id];
    for (const NuscenesSweep& sweep : frame.sweeps)
        if (sweep.before == moment.before)
            return sweep.pose_world_ego;
    return frame.pose_world_ego;
}

std::string NuscenesContent::sample(std::size_t id) const {
    const NuscenesFrame& frame = frames[id];
    return nuscenes_token("sample", logs[frame.trace].chain, frame.tick);
}

std::string NuscenesContent::scene(std::size_t number) const {
    return nuscenes_token("scene", sample(scenes[number]));
}

std::string NuscenesContent::data(const Moment& moment, const NuscenesChannel& channel) const {
    const std::string own = sample(moment.id);
    return moment.is_sweep() ? nuscenes_token("sweep", own, moment.before, channel.name)
                             : nuscenes_token("data", own, channel.name);
}

std::string NuscenesContent::annotation(std::size_t id, std::uint32_t actor) const {
    return nuscenes_token("annotation", sample(id), actor);
}

std::string NuscenesContent::instance(std::size_t number, std::uint32_t actor) const {
    return nuscenes_token("instance", scene(number), actor);
}

std::string NuscenesContent::log(std::size_t trace) const {
    return nuscenes_token("log", logs[trace].chain);
}

std::string NuscenesContent::calibration(std::size_t trace, const NuscenesChannel& channel) const {
    return nuscenes_token("calibration", logs[trace].chain, channel.name);
}

Eigen::Vector3d NuscenesContent::place(std::size_t id, const Eigen::Isometry3d& pose_world) const {
    return pose_world.translation() - logs[frames[id].trace].origin;
}

std::optional<std::size_t> NuscenesContent::beside(std::size_t id, bool next) const {
    if (next ? id + 1 == frames.size() : id == 0)
        return std::nullopt;
    const std::size_t other = next ? id + 1 : id - 1;
    return scene_of[other] == scene_of[id] ? std::optional(other) : std::nullopt;
}

std::optional<Moment> NuscenesContent::beside_moment(std::size_t number, bool next) const {
    if (next ? number + 1 == moments.size() : number == 0)
        return std::nullopt;
    const Moment& other = moments[next ? number + 1 : number - 1];
    return scene_of[other.id] == scene_of[moments[number].id] ? std::optional(other) : std::nullopt;
}

}  // namespace reprise::cli
