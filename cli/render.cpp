#include "cli/render.h"

#include <filesystem>
#include <list>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "cli/options/tick_option.h"
#include "cli/process/guard.h"
#include "cli/process/new_folder.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "cli/recorded_rig.h"
#include "render/picture.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/weather.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;

struct Span {
    std::uint64_t from = 1;
    std::uint64_t to = 1;
    std::uint64_t every = 1;
};

Span ticks_to_render(const RenderOptions& options, const replay::TraceReader& trace) {
    const std::uint64_t step_ns = trace.episode().step_ns;
    Span span;
    span.from = std::max(trace.first(), parse_tick("--from", options.from, step_ns, trace.first()));
    span.to = std::min(trace.last(), parse_tick("--to", options.to, step_ns, trace.last()));
    span.every = parse_tick("--every", options.every.empty() ? "1s" : options.every, step_ns, 0);
    if (span.every < 1)
        throw world::Error("--every: expected 1 tick at least, got '" + options.every + "'");
    if (span.from > span.to)
        throw world::Error(
            fmt::format("nothing to render: from tick {} to {}; {} holds ticks {} to {}",
                        span.from,
                        options.to.empty() ? trace.last() : span.to,
                        options.trace,
                        trace.first(),
                        trace.last()));
    return span;
}

world::SensorKind kind_of(const std::string& camera) {
    return camera == "depth"      ? world::SensorKind::depth
           : camera == "semantic" ? world::SensorKind::semantic
                                  : world::SensorKind::rgb;
}

world::SensorRig make_rig(const RenderOptions& options) {
    world::SensorRig rig;
    for (const std::string& camera : options.cameras) {
        world::SensorSpec sensor;
        sensor.name = camera;
        sensor.kind = kind_of(camera);
        sensor.width = options.width;
        sensor.height = options.height;
        sensor.fov = options.fov_deg * std::numbers::pi / 180;
        sensor.position = {options.mount[0], options.mount[1], options.mount[2]};
        sensor.pitch = options.pitch_deg * std::numbers::pi / 180;
        sensor.yaw = options.yaw_deg * std::numbers::pi / 180;
        rig.push_back(sensor);
    }
    return rig;
}

/// Of an imported trace, which has cars only: the one that it was recorded for.
std::optional<std::uint32_t> hero(const world::EpisodeT& episode, const world::TickView& tick) {
    for (const world::ParameterT& parameter : episode.parameters)
        for (const world::CarState& car : tick.cars())
            if (parameter.key == "hero" && parameter.value == std::to_string(car.id()))
                return car.id();
    return std::nullopt;
}

/// The first vehicle of the tick, unless one was named. Nothing when there is none yet.
std::optional<std::uint32_t> mount_actor(const RenderOptions& options,
                                         const world::EpisodeT& episode,
                                         const world::TickView& tick) {
    if (options.actor != 0)
        return options.actor;
    if (!episode.imported_from.empty())
        return hero(episode, tick);
    if (tick.vehicles().empty())
        return std::nullopt;
    return tick.vehicles().front().id();
}

/// Who carries a recorded rig, as long as it is there.
std::optional<std::uint32_t> mounted(const world::Rig& rig, const world::TickView& tick) {
    const std::uint32_t actor = rig.sensors.front().actor;
    return world::find(tick.vehicles(), actor) == nullptr ? std::nullopt : std::optional(actor);
}

void save(const world::SensorFrame& frame, const fs::path& folder) {
    const std::string name = fmt::format("{:06}.png", frame.tick);
    render::write_png(frame, folder / name);
    if (frame.kind != world::SensorKind::rgb)
        render::write_png(render::viewable(frame), folder / "view" / name);
}

/// What to look with, and where its pictures go.
struct Cameras {
    world::SensorRig sensors;
    std::optional<world::Rig> recorded;  ///< what the vehicle carried, where that is rendered
    std::vector<fs::path> folders;       ///< of each sensor
};

Cameras find_cameras(const RenderOptions& options, replay::TraceReader& trace, std::uint64_t last) {
    Cameras cameras;
    if (options.recorded_rig)
        cameras.recorded = recorded_rig(trace, options.actor, last);
    cameras.sensors = cameras.recorded ? cameras.recorded->sensors : make_rig(options);
    const fs::path folder = options.directory;
    for (const world::SensorSpec& sensor : cameras.sensors)
        cameras.folders.push_back(
            cameras.recorded || cameras.sensors.size() > 1 ? folder / sensor.name : folder);
    return cameras;
}

/// Those that stay empty go again.
std::list<NewFolder> make_folders(const Cameras& cameras) {
    std::list<NewFolder> folders;
    for (std::size_t i = 0; i < cameras.folders.size(); ++i)
        folders.emplace_front(cameras.sensors[i].kind == world::SensorKind::rgb
                                  ? cameras.folders[i]
                                  : cameras.folders[i] / "view");
    return folders;
}

/// The sensors that look in a tick, by their index: those of a recorded rig where they looked in
/// the run, unless every so many ticks were asked for.
std::vector<std::size_t> due(const Cameras& cameras,
                             const RenderOptions& options,
                             std::uint64_t tick) {
    if (cameras.recorded && options.every.empty())
        return cameras.recorded->due(tick);
    std::vector<std::size_t> all(cameras.sensors.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

}  // namespace

int render(const RenderOptions& options) {
    replay::TraceReader trace(options.trace);
    Span span = ticks_to_render(options, trace);
    const Cameras cameras = find_cameras(options, trace, span.to);
    if (cameras.recorded && options.every.empty())
        span.every = 1;
    if (options.recorded_rig && !cameras.recorded && trace.first() > 1)
        say(stderr,
            "reprise: {}: begins at tick {}: what a vehicle carries that was there before is not "
            "in it, "
            "only in the whole trace; rendered as without a rig\n",
            options.trace,
            trace.first());
    const std::list<NewFolder> folders = make_folders(cameras);
    render::Sensors sensors(trace.recording().town,
                            {.threads = options.threads, .portable = options.portable});
    const world::WeatherPreset* other = world::find_weather(options.weather);
    Progress progress("rendering", "ticks", (span.to - span.from) / span.every + 1);
    std::uint64_t ticks = 0;
    std::size_t pictures = 0;
    for (std::uint64_t index = span.from; index <= span.to; index += span.every) {
        progress.update(++ticks);
        const std::vector<std::size_t> looking = due(cameras, options, index);
        if (looking.empty())
            continue;
        const world::TickView tick = trace.tick(index).view;
        const auto actor = cameras.recorded ? mounted(*cameras.recorded, tick)
                                            : mount_actor(options, trace.episode(), tick);
        if (!actor)
            continue;
        world::SensorRig rig;
        for (const std::size_t i : looking) {
            rig.push_back(cameras.sensors[i]);
            rig.back().actor = *actor;
        }
        const world::Weather& weather = other != nullptr ? other->weather : *tick.tick->weather();
        const std::vector<world::SensorFrame> frames = sensors.observe(tick, rig, weather);
        for (std::size_t i = 0; i < frames.size(); ++i)
            save(frames[i], cameras.folders[looking[i]]);
        pictures += frames.size();
    }
    progress.clear();
    say("{}: {} pictures of {} in {:.2f} s\n",
        options.directory,
        pictures,
        other != nullptr ? other->name : trace.episode().weather_name,
        progress.seconds());
    if (pictures == 0)
        throw world::Error("no vehicle to mount the camera on in these ticks of " + options.trace);
    return exit_good;
}

}  // namespace reprise::cli
