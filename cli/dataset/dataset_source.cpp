#include "cli/dataset/dataset_source.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "cli/dataset/nuscenes_names.h"
#include "cli/options/option_checks.h"
#include "cli/options/tick_option.h"
#include "cli/options/tick_range.h"
#include "cli/pictures/rig_file.h"
#include "render/trace/camera.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

RenderOptions options_for(const DatasetOptions& dataset, const std::string& trace) {
    RenderOptions options;
    options.trace = trace;
    options.output = dataset.output;
    options.rig = dataset.rig;
    options.cameras = {"rgb"};
    options.recorded_rig = false;
    options.no_view = true;
    options.every = dataset.every;
    options.actor = dataset.actor;
    options.fov_deg = dataset.fov_deg;
    options.threads = dataset.threads;
    options.portable = dataset.portable;
    try {
        const PictureSize size = read_picture_size(dataset.size, "1242x375");
        options.width = size.width;
        options.height = size.height;
    } catch (const world::Error& error) {
        throw world::Error(std::string("--size: ") + error.what());
    }
    return options;
}

/// Whether a data set has room for what it measures.
bool has_place(world::SensorKind kind) {
    return world::is_camera(kind) ||
           (world::is_ranging(kind) && kind != world::SensorKind::obstacle);
}

/// nuScenes has one car that carries all, pinholes, and a name of its own for each sensor.
void check_nuscenes(const RigFile& file, const std::string& path) {
    std::map<std::string, std::string> channels;
    bool lidar = false;
    for (std::size_t i = 0; i < file.rig.sensors.size(); ++i) {
        const world::SensorSpec& sensor = file.rig.sensors[i];
        const auto refuse = [&](const std::string& why) {
            throw world::Error(fmt::format("{}: sensor '{}': {}", path, sensor.name, why));
        };
        if (file.carriers[i] != file.carriers[0] || file.carriers[i] == "world")
            refuse("in nuScenes one car carries all sensors");
        const bool first = sensor.kind == world::SensorKind::lidar && !lidar;
        lidar = lidar || first;
        if (sensor.kind == world::SensorKind::rgb &&
            !render::Camera(sensor, Eigen::Isometry3d::Identity()).lens().is_plain())
            refuse("nuScenes' cameras are pinholes: without the attributes of its lens");
        if (sensor.kind != world::SensorKind::rgb &&
            (world::is_camera(sensor.kind) || sensor.kind == world::SensorKind::semantic_lidar))
            continue;
        const std::string channel = nuscenes_channel(sensor, first);
        const auto [other, fresh] = channels.emplace(channel, sensor.name);
        if (!fresh)
            refuse(fmt::format("is {} in nuScenes, as '{}' is", channel, other->second));
    }
}

}  // namespace

DatasetSource::DatasetSource(const DatasetOptions& dataset, const std::string& path)
    : options_(options_for(dataset, path)),
      trace_(std::make_unique<replay::TraceReader>(path)) {
    const TickRange range = parse_ticks("--ticks", dataset.ticks, *trace_);
    ticks_.from = range.first;
    ticks_.to = range.last;
    ticks_.every = parse_tick("--every", dataset.every, trace_->episode().step_ns, 0);
    if (ticks_.every < 1)
        throw world::Error("--every: expected 1 tick at least, got '" + dataset.every + "'");
    read_sweeps(dataset);
    if (!options_.rig.empty())
        check_rig(dataset.format == "nuscenes");
    cameras_ = std::make_unique<Cameras>(options_, *trace_, ticks_);
    rays_ = std::make_unique<MeasuredRig>(options_, *trace_, ticks_);
    const world::SensorRig& rays = rays_->sensors();
    const auto lidar = std::find_if(rays.begin(), rays.end(), [](const world::SensorSpec& one) {
        return one.kind == world::SensorKind::lidar;
    });
    has_twin_ = dataset.format == "nuscenes" && lidar != rays.end();
    if (sweep_ > 0)
        rays_->look_every(static_cast<std::uint32_t>(sweep_));
    if (has_twin_)
        rays_->add_semantic_twin(static_cast<std::size_t>(lidar - rays.begin()));
}

void DatasetSource::read_sweeps(const DatasetOptions& dataset) {
    if (dataset.sweeps.empty())
        return;
    if (dataset.format != "nuscenes")
        throw world::Error("--sweeps: only of --format nuscenes");
    sweep_ = parse_tick("--sweeps", dataset.sweeps, trace_->episode().step_ns, 0);
    if (sweep_ < 1 || sweep_ >= ticks_.every || ticks_.every % sweep_ != 0)
        throw world::Error(fmt::format("--sweeps: --every, {}, must be a multiple of it, got '{}'",
                                       world::count_of(ticks_.every, "tick"),
                                       dataset.sweeps));
}

void DatasetSource::check_rig(bool nuscenes) const {
    const RigFile file = read_rig_file(options_.rig, *trace_);
    const world::SensorRig& sensors = file.rig.sensors;
    const auto index_of = [&](world::SensorKind kind) {
        std::size_t i = 0;
        while (i < sensors.size() && sensors[i].kind != kind)
            ++i;
        return i;
    };
    for (const world::SensorSpec& sensor : sensors)
        if (!has_place(sensor.kind))
            throw world::Error(fmt::format(
                "{}: sensor '{}': a data set holds what cameras, LiDARs and radars see; reprise "
                "render --rig writes what sensors of type {} measure",
                options_.rig,
                sensor.name,
                world::EnumNameSensorKind(sensor.kind)));
    const std::size_t lidar = index_of(world::SensorKind::lidar);
    const bool sees = index_of(world::SensorKind::rgb) < sensors.size();
    if (!sees && !nuscenes)
        throw world::Error(options_.rig + ": a data set needs a camera of type rgb");
    if (!sees && lidar == sensors.size())
        throw world::Error(options_.rig + ": nuScenes needs a camera of type rgb, or a lidar");
    for (std::size_t i = 0; i < sensors.size() && lidar < sensors.size(); ++i)
        if (sensors[i].kind == world::SensorKind::rgb && file.carriers[i] != file.carriers[lidar])
            throw world::Error(
                fmt::format("{}: '{}' and '{}' have carriers of their own, and no calibration "
                            "takes the points of one to the other",
                            options_.rig,
                            sensors[lidar].name,
                            sensors[i].name));
    if (nuscenes)
        check_nuscenes(file, options_.rig);
}

world::SensorRig DatasetSource::own_rays() const {
    world::SensorRig rays = rays_->sensors();
    if (has_twin_)
        rays.pop_back();
    return rays;
}

std::uint32_t DatasetSource::ego(const world::TickView& tick) const {
    return cameras_->sensors().empty()
               ? rays_->carriers(tick).begin()->second
               : cameras_->placed(0, cameras_->actor(tick).value_or(0), tick).actor;
}

bool DatasetSource::are_all_there(const world::TickView& tick) const {
    bool all = (cameras_->sensors().empty() || cameras_->actor(tick).has_value()) &&
               rays_->carriers(tick).size() == rays_->sensors().size();
    for (std::size_t i = 0; all && i < cameras_->sensors().size(); ++i)
        all = cameras_->is_there(i, tick);
    return all;
}

std::map<std::uint64_t, Moment> DatasetSource::sweeps(
    std::size_t number, const std::vector<DatasetFrame>& frames) const {
    std::map<std::uint64_t, Moment> found;
    for (std::size_t id = 1; sweep_ > 0 && id < frames.size(); ++id) {
        const DatasetFrame& frame = frames[id];
        const DatasetFrame& last = frames[id - 1];
        if (frame.trace != number || last.trace != number || last.split != frame.split)
            continue;
        for (std::uint64_t tick = last.tick + sweep_; tick < frame.tick; tick += sweep_)
            if (are_all_there(trace_->tick(tick).view))
                found.emplace(tick, Moment(id, frame.tick - tick));
    }
    return found;
}

void DatasetSource::add_frames(std::size_t number, std::vector<DatasetFrame>& frames) const {
    const std::size_t before = frames.size();
    for (std::uint64_t tick = ticks_.from; tick <= ticks_.to; tick += ticks_.every) {
        if (are_all_there(trace_->tick(tick).view))
            frames.push_back({number, tick, ""});
    }
    if (frames.size() == before)
        throw world::Error("no vehicle to mount the cameras on in these ticks of " + path());
}

}  // namespace reprise::cli
