#include "cli/render.h"

#include <memory>

#include <fmt/format.h>

#include "cli/options/tick_option.h"
#include "cli/options/tick_range.h"
#include "cli/pictures/annotation.h"
#include "cli/pictures/cameras.h"
#include "cli/pictures/picture_output.h"
#include "cli/process/guard.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "render/picture.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/weather.h"

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

std::unique_ptr<PictureOutput> open_output(const RenderOptions& options,
                                           const Cameras& cameras,
                                           const Ticks& ticks,
                                           std::uint64_t step_ns) {
    const std::string ending = film_ending(options.output);
    if (ending.empty())
        return std::make_unique<PictureFolders>(options.output, cameras);
    const std::uint64_t every =
        as_recorded(options, cameras) ? cameras.recorded()->every.front() : ticks.every;
    return std::make_unique<Film>(
        options.output, ending, cameras, 1e9 / static_cast<double>(step_ns * every));
}

/// Renders the ticks, one after the other.
class Renderer {
  public:
    Renderer(const RenderOptions& options,
             replay::TraceReader& trace,
             const Cameras& cameras,
             PictureOutput& output)
        : trace_(trace),
          cameras_(cameras),
          output_(output),
          annotation_(options, trace),
          sensors_(trace.recording().town,
                   {.threads = options.threads, .portable = options.portable}),
          weather_(world::find_weather(options.weather)) {}

    /// Returns how many pictures were taken. `last`: nothing comes after it, and the run ends so.
    std::size_t look(std::uint64_t index, bool last) {
        const std::vector<std::size_t> looking = cameras_.due(index);
        if (looking.empty())
            return 0;
        annotation_.read_to(last ? trace_.last() : index);
        const world::TickView tick = trace_.tick(index).view;
        const auto actor = cameras_.actor(tick);
        if (!actor)
            return 0;
        world::SensorRig rig;
        for (const std::size_t i : looking)
            rig.push_back(cameras_.placed(i, *actor, tick));
        // Cameras of one place look together: what is seen is found once.
        if (annotation_.needs_depth())
            for (std::size_t i = 0; i < looking.size(); ++i) {
                rig.push_back(rig[i]);
                rig.back().kind = world::SensorKind::depth;
            }
        const std::vector<world::SensorFrame> frames = sensors_.observe(
            tick, rig, weather_ != nullptr ? weather_->weather : *tick.tick->weather());
        for (std::size_t i = 0; i < looking.size(); ++i) {
            world::SensorFrame shown = render::viewable(frames[i]);
            const std::size_t depth = looking.size() + i;
            annotation_.write(shown,
                              depth < frames.size() ? &frames[depth] : nullptr,
                              {tick, rig[i], *actor, last});
            output_.take(looking[i], frames[i], shown);
        }
        return looking.size();
    }

    std::string weather_name() const {
        return weather_ != nullptr ? weather_->name : trace_.episode().weather_name;
    }

  private:
    replay::TraceReader& trace_;
    const Cameras& cameras_;
    PictureOutput& output_;
    Annotation annotation_;
    render::Sensors sensors_;
    const world::WeatherPreset* weather_;  ///< none: as recorded
};

}  // namespace

int render(const RenderOptions& options) {
    replay::TraceReader trace(options.trace);
    Ticks ticks = ticks_to_render(options, trace);
    const Cameras cameras(options, trace, ticks);
    const auto output = open_output(options, cameras, ticks, trace.episode().step_ns);
    if (as_recorded(options, cameras))
        ticks.every = 1;
    Renderer renderer(options, trace, cameras, *output);
    Progress progress("rendering", "ticks", (ticks.to - ticks.from) / ticks.every + 1);
    std::uint64_t done = 0;
    std::size_t pictures = 0;
    for (std::uint64_t index = ticks.from; index <= ticks.to; index += ticks.every) {
        progress.update(++done);
        const bool ends = ticks.to == trace.last() && index + ticks.every > ticks.to;
        pictures += renderer.look(index, ends);
    }
    if (pictures == 0)
        throw world::Error("no vehicle to mount the camera on in these ticks of " + options.trace);
    output->finish();
    progress.clear();
    say("{}: {} pictures of {} in {:.2f} s\n",
        options.output,
        pictures,
        renderer.weather_name(),
        progress.seconds());
    return exit_good;
}

}  // namespace reprise::cli
