#include "cli/render.h"

#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/options/tick_option.h"
#include "cli/options/tick_range.h"
#include "cli/pictures/annotation.h"
#include "cli/pictures/box_text.h"
#include "cli/pictures/cameras.h"
#include "cli/pictures/kept_ticks.h"
#include "cli/pictures/measurements.h"
#include "cli/pictures/picture_output.h"
#include "cli/process/guard.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "render/picture.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/external/sensor_attributes.h"
#include "world/weather/weather_text.h"

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
        return std::make_unique<PictureFolders>(options, cameras);
    const std::uint64_t every =
        as_recorded(options, cameras) ? cameras.recorded()->every.front() : ticks.every;
    return std::make_unique<Film>(
        options.output, ending, cameras, 1e9 / static_cast<double>(step_ns * every));
}

/// A tick's cameras and what becomes of their pictures. Keeps the tick: the trace is read on while
/// it is looked at.
class LookAtTick : public render::Observation {
  public:
    LookAtTick(KeptTicks ticks, const Annotation& annotation, PictureOutput& output, bool boxes)
        : ticks_(std::move(ticks)),
          annotation_(annotation),
          output_(output),
          boxes_(boxes) {}

    world::TickView tick() const override { return ticks_.tick.view(); }

    render::Neighbours neighbours() const override { return neighbours_; }

    const world::SensorRig& rig() const override { return rig_; }

    const world::Weather& weather() const override { return weather_; }

    /// `last`: nothing comes after it, and the run ends so.
    void point(const Cameras& cameras,
               const std::vector<std::size_t>& looking,
               std::uint32_t actor,
               const std::optional<world::WeatherPreset>& weather,
               bool last) {
        looking_ = looking;
        actor_ = actor;
        last_ = last;
        weather_ = weather ? weather->weather : *tick().tick->weather();
        for (const std::size_t i : looking)
            rig_.push_back(cameras.placed(i, actor, tick()));
        words_ = annotation_.words({tick(), rig_.front(), actor, last});
        // Cameras of one place look together: what is seen is found once.
        if (annotation_.needs_depth())
            look_also(world::SensorKind::depth);
        first_of_boxes_ = rig_.size();
        if (boxes_) {
            look_also(world::SensorKind::instance);
            look_also(world::SensorKind::semantic);
        }
        if (ticks_.last)
            neighbours_.last = neighbour(cameras, ticks_.last->view());
        if (ticks_.next)
            neighbours_.next = neighbour(cameras, ticks_.next->view());
    }

    void seen(std::vector<world::SensorFrame> frames) override {
        frames_ = std::move(frames);
        for (std::size_t i = 0; i < looking_.size(); ++i) {
            shown_.push_back(output_.shows(looking_[i]) ? shown(i) : world::SensorFrame());
            if (!output_.in_order())
                output_.take(looking_[i], frames_[i], shown_[i]);
            if (boxes_)
                output_.take_text(looking_[i],
                                  "boxes",
                                  tick().index(),
                                  box_text(tick(),
                                           rig_[i],
                                           frames_[first_of_boxes_ + i],
                                           frames_[first_of_boxes_ + looking_.size() + i]));
        }
    }

    void done() override {
        for (std::size_t i = 0; i < looking_.size() && output_.in_order(); ++i)
            output_.take(looking_[i], frames_[i], shown_[i]);
    }

  private:
    /// Each camera sees this as well.
    void look_also(world::SensorKind kind) {
        for (std::size_t i = 0; i < looking_.size(); ++i) {
            rig_.push_back(rig_[i]);
            rig_.back().kind = kind;
            // What is of another kind, it would not know.
            std::erase_if(rig_.back().attributes, [&](const world::AttributeValue& one) {
                return world::find_attribute(kind, one.name) == nullptr;
            });
        }
    }

    /// The same cameras there; nothing where they are not.
    std::optional<render::Neighbour> neighbour(const Cameras& cameras,
                                               const world::TickView& there) const {
        if (!cameras.actor(there))
            return std::nullopt;
        render::Neighbour found{there, rig_};
        for (std::size_t i = 0; i < looking_.size(); ++i) {
            const world::SensorSpec placed = cameras.placed(looking_[i], actor_, there);
            found.rig[i].actor = placed.actor;
            found.rig[i].position = placed.position;
            found.rig[i].yaw = placed.yaw;
            found.rig[i].pitch = placed.pitch;
        }
        return found;
    }

    world::SensorFrame shown(std::size_t i) const {
        world::SensorFrame shown = render::viewable(frames_[i]);
        const std::size_t depth = looking_.size() + i;
        annotation_.write(shown,
                          annotation_.needs_depth() ? &frames_[depth] : nullptr,
                          {tick(), rig_[i], actor_, last_},
                          words_);
        return shown;
    }

    KeptTicks ticks_;
    const Annotation& annotation_;
    PictureOutput& output_;
    bool boxes_;
    std::size_t first_of_boxes_ = 0;  ///< of rig_: the instances, behind them the classes
    render::Neighbours neighbours_;
    std::vector<std::size_t> looking_;  ///< by their index in Cameras::sensors()
    std::uint32_t actor_ = 0;
    bool last_ = false;
    world::Weather weather_;
    world::SensorRig rig_;
    Annotation::Words words_;
    std::vector<world::SensorFrame> frames_;
    std::vector<world::SensorFrame> shown_;
};

std::optional<world::WeatherPreset> weather_of(const RenderOptions& options) {
    if (options.weather.empty())
        return std::nullopt;
    return world::read_weather(options.weather);
}

/// Goes through the ticks, and says who looks at each.
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
          boxes_(options.boxes),
          weather_(weather_of(options)) {}

    /// Nobody looks at some ticks. `last`: nothing comes after it, and the run ends so.
    std::unique_ptr<LookAtTick> look(std::uint64_t index, bool last) {
        std::vector<std::size_t> looking = cameras_.due(index);
        if (looking.empty())
            return nullptr;
        annotation_.read_to(last ? trace_.last() : index);
        auto look = std::make_unique<LookAtTick>(
            KeptTicks(trace_, index, cameras_.see_motion()), annotation_, output_, boxes_);
        const auto actor = cameras_.actor(look->tick());
        std::erase_if(looking, [&](std::size_t i) { return !cameras_.is_there(i, look->tick()); });
        if (!actor || looking.empty())
            return nullptr;
        look->point(cameras_, looking, *actor, weather_, last);
        pictures_ += looking.size();
        return look;
    }

    std::size_t pictures() const { return pictures_; }

    std::string weather_name() const {
        return weather_ ? weather_->name : trace_.episode().weather_name;
    }

  private:
    replay::TraceReader& trace_;
    const Cameras& cameras_;
    PictureOutput& output_;
    Annotation annotation_;
    bool boxes_;
    std::optional<world::WeatherPreset> weather_;  ///< none: as recorded
    std::size_t pictures_ = 0;
};

void render_pictures(const RenderOptions& options,
                     replay::TraceReader& trace,
                     Ticks ticks,
                     const Cameras& cameras,
                     render::Sensors& sensors) {
    const auto output = open_output(options, cameras, ticks, trace.episode().step_ns);
    if (as_recorded(options, cameras))
        ticks.every = 1;
    Renderer renderer(options, trace, cameras, *output);
    Progress progress("rendering", "ticks", (ticks.to - ticks.from) / ticks.every + 1);
    std::uint64_t done = 0;
    std::uint64_t index = ticks.from;
    sensors.observe_each([&]() -> std::unique_ptr<render::Observation> {
        for (; index <= ticks.to; index += ticks.every) {
            progress.update(++done);
            const bool ends = ticks.to == trace.last() && index + ticks.every > ticks.to;
            if (auto look = renderer.look(index, ends)) {
                index += ticks.every;
                return look;
            }
        }
        return nullptr;
    });
    if (renderer.pictures() == 0)
        throw world::Error("no vehicle to mount the camera on in these ticks of " + options.trace);
    output->finish();
    progress.clear();
    say("{}: {} pictures of {} in {:.2f} s\n",
        options.output,
        renderer.pictures(),
        renderer.weather_name(),
        progress.seconds());
}

}  // namespace

int render(const RenderOptions& options) {
    replay::TraceReader trace(options.trace);
    const Ticks ticks = ticks_to_render(options, trace);
    Measurements measurements(options, trace, ticks);
    const Cameras cameras(options, trace, ticks);
    // The town takes seconds to build, and sensors without rays do not look at it.
    std::optional<render::Sensors> made;
    const auto sensors = [&]() -> render::Sensors& {
        const render::Sensors::Options how{.threads = options.threads,
                                           .portable = options.portable};
        return made ? *made : made.emplace(trace.recording().town, how);
    };
    if (!measurements.empty() && film_ending(options.output).empty())
        say("{}: {} frames and readings of {}\n",
            options.output,
            measurements.write(sensors),
            measurements.names());
    if (!cameras.sensors().empty())
        render_pictures(options, trace, ticks, cameras, sensors());
    return exit_good;
}

}  // namespace reprise::cli
