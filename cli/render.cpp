#include "cli/render.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/check_render.h"
#include "cli/measured/measurements.h"
#include "cli/options/tick_option.h"
#include "cli/options/tick_range.h"
#include "cli/pictures/cameras.h"
#include "cli/pictures/earlier_rendering.h"
#include "cli/pictures/manifest.h"
#include "cli/pictures/picture_output.h"
#include "cli/pictures/renderer.h"
#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

Ticks ticks_to_render(const RenderOptions& options, const replay::TraceReader& trace) {
    const std::uint64_t step_ns = trace.episode().step_ns;
    const bool film = !film_ending(options.output).empty();
    const TickRange range = parse_ticks("--ticks", options.ticks, trace);
    Ticks ticks;
    ticks.from = std::max(range.first, parse_tick("--from", options.from, step_ns, range.first));
    ticks.to = std::min(range.last, parse_tick("--to", options.to, step_ns, range.last));
    const std::string usual = film ? "1" : "1s";
    ticks.every = parse_tick("--every", options.every.empty() ? usual : options.every, step_ns, 0);
    if (ticks.every < 1)
        throw world::Error("--every: expected 1 tick at least, got '" + options.every + "'");
    if (ticks.from > ticks.to)
        throw world::Error(
            fmt::format("nothing to render: from tick {} to {}; {} holds ticks {} to {}",
                        ticks.from,
                        options.to.empty() ? trace.last() : ticks.to,
                        options.trace,
                        trace.first(),
                        trace.last()));
    return ticks;
}

/// Of a recorded rig each tick is looked at: its sensors have periods of their own.
bool as_recorded(const RenderOptions& options, const Cameras& cameras) {
    return cameras.recorded() && options.every.empty();
}

/// The weathers of a film that shows several.
std::vector<std::string> side_by_side(const RenderOptions& options) {
    constexpr std::size_t most = 8;
    if (options.compare.empty())
        return {};
    std::vector<std::string> weathers;
    try {
        weathers = weather_list(options.compare);
    } catch (const world::Error& error) {
        throw world::Error(std::string("--compare: ") + error.what());
    }
    if (weathers.size() < 2 || weathers.size() > most)
        throw world::Error(
            fmt::format("--compare: expected 2 to {} weathers such as "
                        "clear_noon,hard_rain_sunset, got '{}'",
                        most,
                        options.compare));
    return weathers;
}

/// How something is written that none of the sensors makes: who asks for it waits for files in
/// vain.
void check_formats(const RenderOptions& options,
                   const Cameras& cameras,
                   const Measurements& measurements) {
    struct Format {
        std::string_view option;
        std::vector<std::string> kinds;
    };

    const std::vector<std::string> floats{"depth", "flow", "normals"};
    const std::vector<Format> formats{
        {"--depth-coding", {"depth"}},
        {"--classes", {"semantic"}},
        {"--events", {"dvs"}},
        {"--npy", floats},
        {"--exr", floats},
        {"--points", {"lidar", "semantic_lidar", "radar"}},
        {"--readings", {"gnss", "imu", "collision", "lane_invasion", "obstacle"}}};
    std::vector<std::string> made;
    for (const world::SensorRig& rig : {cameras.sensors(), measurements.sensors()})
        for (const world::SensorSpec& sensor : rig)
            made.emplace_back(world::EnumNameSensorKind(sensor.kind));
    for (const auto& format : formats) {
        const std::string_view option = format.option;
        const std::vector<std::string>& kinds = format.kinds;
        const bool asked = std::any_of(options.said.begin(),
                                       options.said.end(),
                                       [&](const auto& said) { return said.first == option; });
        if (asked &&
            std::find_first_of(made.begin(), made.end(), kinds.begin(), kinds.end()) == made.end())
            throw world::Error(fmt::format("{}: says how {} {} written, and none is made here",
                                           option,
                                           fmt::join(kinds, ", "),
                                           kinds.size() > 1 ? "are" : "is"));
    }
}

std::unique_ptr<PictureOutput> open_output(const RenderOptions& options,
                                           const Cameras& cameras,
                                           const Ticks& ticks,
                                           std::uint64_t step_ns,
                                           WrittenFiles& files) {
    const std::string ending = film_ending(options.output);
    if (ending.empty())
        return std::make_unique<PictureFolders>(options, cameras, files);
    const std::uint64_t every =
        as_recorded(options, cameras) ? cameras.recorded()->every.front() : ticks.every;
    return std::make_unique<Film>(options.output,
                                  ending,
                                  cameras,
                                  1e9 / static_cast<double>(step_ns * every),
                                  std::max<std::size_t>(1, side_by_side(options).size()),
                                  files);
}

void render_pictures(const RenderOptions& options,
                     replay::TraceReader& trace,
                     Ticks ticks,
                     const Cameras& cameras,
                     render::Sensors& sensors,
                     WrittenFiles& files) {
    const auto begin = std::chrono::steady_clock::now();
    const auto output = open_output(options, cameras, ticks, trace.episode().step_ns, files);
    if (as_recorded(options, cameras))
        ticks.every = 1;
    const std::vector<std::string> beside = side_by_side(options);
    Renderer renderer(options, trace, cameras, *output, beside);
    renderer.look_at_all(sensors, ticks, "rendering");
    output->finish();
    const std::string recorded = trace.episode().weather_name;
    if (!options.quiet)
        say("{}: {} of {} in {:.2f} s\n",
            options.output,
            world::count_of(renderer.pictures(), "picture"),
            !beside.empty()           ? options.compare
            : options.weather.empty() ? recorded
                                      : options.weather,
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

}  // namespace

int render(const RenderOptions& options) {
    if (!options.check.empty())
        return check_render(options, render);
    side_by_side(options);
    replay::TraceReader trace(options.trace);
    const Ticks ticks = ticks_to_render(options, trace);
    Measurements measurements(options, trace, ticks);
    const Cameras cameras(options, trace, ticks);
    check_formats(options, cameras, measurements);
    const bool film = !film_ending(options.output).empty();
    if (film && cameras.sensors().empty())
        throw world::Error(options.output + ": a film shows a camera, and there is none in " +
                           (options.rig.empty() ? options.trace : options.rig));
    const EarlierRendering earlier(options.output);
    WrittenFiles files;
    // The town takes seconds to build, and sensors without rays do not look at it.
    std::optional<render::Sensors> made;
    const auto sensors = [&]() -> render::Sensors& {
        const render::Sensors::Options how{.threads = options.threads,
                                           .portable = options.portable};
        return made ? *made : made.emplace(trace.recording().town, how);
    };
    if (!measurements.empty() && !film) {
        const std::size_t count = measurements.write(sensors, files);
        if (!options.quiet)
            say("{}: {} of {}\n",
                options.output,
                world::count_of(count, "frame or reading", "frames and readings"),
                measurements.names());
    }
    if (!cameras.sensors().empty())
        render_pictures(options, trace, ticks, cameras, sensors(), files);
    std::vector<MountedSensor> all;
    for (std::size_t i = 0; i < cameras.sensors().size(); ++i)
        all.push_back({cameras.sensors()[i], cameras.carrier(i)});
    for (std::size_t i = 0; i < measurements.sensors().size() && !film; ++i)
        all.push_back({measurements.sensors()[i], measurements.carrier(i)});
    write_manifest(options, trace, ticks, all, files);
    if (const auto left = earlier.left_beside(files); !left.empty() && !options.quiet)
        say("{}: {} of an earlier rendering there, such as {}; the new manifest is not about "
            "them\n",
            options.output,
            world::count_of(left.size(), "file is left", "files are left"),
            left.front().string());
    return exit_good;
}

}  // namespace reprise::cli
