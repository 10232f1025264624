#include "cli/render.h"

#include <filesystem>
#include <list>
#include <numbers>

#include <fmt/format.h>

#include "cli/options/tick_option.h"
#include "cli/process/guard.h"
#include "cli/process/new_folder.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
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
    span.every = parse_tick("--every", options.every, step_ns, 0);
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

void save(const world::SensorFrame& frame, const fs::path& folder) {
    const std::string name = fmt::format("{:06}.png", frame.tick);
    render::write_png(frame, folder / name);
    if (frame.kind != world::SensorKind::rgb)
        render::write_png(render::viewable(frame), folder / "view" / name);
}

/// Those that stay empty go again.
std::list<NewFolder> make_folders(const RenderOptions& options) {
    std::list<NewFolder> folders;
    for (const std::string& camera : options.cameras) {
        const fs::path folder = options.cameras.size() == 1 ? fs::path(options.directory)
                                                            : fs::path(options.directory) / camera;
        folders.emplace_front(camera == "rgb" ? folder : folder / "view");
    }
    return folders;
}

}  // namespace

int render(const RenderOptions& options) {
    replay::TraceReader trace(options.trace);
    const Span span = ticks_to_render(options, trace);
    world::SensorRig rig = make_rig(options);
    const std::list<NewFolder> folders = make_folders(options);
    render::Sensors sensors(trace.recording().town,
                            {.threads = options.threads, .portable = options.portable});
    const world::WeatherPreset* other = world::find_weather(options.weather);
    Progress progress("rendering", "pictures", (span.to - span.from) / span.every + 1);
    std::uint64_t done = 0;
    for (std::uint64_t index = span.from; index <= span.to; index += span.every) {
        const world::TickView tick = trace.tick(index).view;
        const auto actor = mount_actor(options, trace.episode(), tick);
        if (!actor)
            continue;
        for (world::SensorSpec& sensor : rig)
            sensor.actor = *actor;
        const world::Weather& weather = other != nullptr ? other->weather : *tick.tick->weather();
        for (const world::SensorFrame& frame : sensors.observe(tick, rig, weather))
            save(frame,
                 rig.size() == 1 ? fs::path(options.directory)
                                 : fs::path(options.directory) / frame.name);
        progress.update(++done);
    }
    progress.clear();
    say("{}: {} pictures of {} in {:.2f} s\n",
        options.directory,
        done * rig.size(),
        other != nullptr ? other->name : trace.episode().weather_name,
        progress.seconds());
    if (done == 0)
        throw world::Error("no vehicle to mount the camera on in these ticks of " + options.trace);
    return exit_good;
}

}  // namespace reprise::cli
