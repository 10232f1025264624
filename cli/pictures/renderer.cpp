#include "cli/pictures/renderer.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/process/progress.h"
#include "world/check.h"

namespace reprise::cli {

Renderer::Renderer(const RenderOptions& options,
                   replay::TraceReader& trace,
                   const Cameras& cameras,
                   PictureOutput& output,
                   const std::vector<std::string>& weathers)
    : trace_(trace),
      cameras_(cameras),
      output_(output),
      annotation_(options, trace) {
    if (options.boxes)
        parked_ = render::parked_vehicles(trace.recording().town);
    const double step = static_cast<double>(trace.episode().step_ns) * 1e-9;
    for (const std::string& weather : weathers)
        weathers_.emplace_back(weather, step);
    if (weathers.empty())
        weathers_.emplace_back(options.weather, step);
}

/// Nobody looks at some ticks. `last`: nothing comes after it, and the run ends so.
std::unique_ptr<LookAtTick> Renderer::look(std::uint64_t index,
                                           const ChosenWeather& weather,
                                           bool last) {
    std::vector<std::size_t> looking = cameras_.due(index);
    const bool due = !looking.empty();
    due_ = due_ || due;
    std::erase_if(looking, [&](std::size_t i) { return !output_.wants(i, index); });
    carried_ = carried_ || (due && looking.empty());
    if (looking.empty())
        return nullptr;
    annotation_.read_to(last ? trace_.last() : index);
    auto look = std::make_unique<LookAtTick>(KeptTicks(trace_, index, cameras_.see_motion()),
                                             annotation_,
                                             output_,
                                             parked_ ? &*parked_ : nullptr);
    const auto actor = cameras_.actor(look->tick());
    std::erase_if(looking, [&](std::size_t i) { return !cameras_.is_there(i, look->tick()); });
    if (!actor || looking.empty())
        return nullptr;
    carried_ = true;
    look->point(cameras_, looking, *actor, weather.at(look->tick()), last);
    pictures_ += looking.size();
    return look;
}

void Renderer::refuse_gap(const Ticks& ticks) const {
    std::uint64_t next = ticks.to + 1;
    while (next <= trace_.last() && cameras_.due(next).empty())
        ++next;
    throw world::Error(fmt::format(
        "{}: no camera of the rig looks in ticks {} to {}{}; --every says other ticks than the rig",
        trace_.path().string(),
        ticks.from,
        ticks.to,
        next <= trace_.last() ? fmt::format("; the next one does in tick {}", next) : ""));
}

void Renderer::look_at_all(render::Sensors& sensors, const Ticks& ticks, const std::string& doing) {
    Progress progress(doing, "ticks", (ticks.to - ticks.from) / ticks.every + 1);
    std::uint64_t done = 0;
    std::uint64_t index = ticks.from;
    std::size_t weather = 0;
    sensors.observe_each([&]() -> std::unique_ptr<render::Observation> {
        while (index <= ticks.to) {
            const bool ends = ticks.to == trace_.last() && index + ticks.every > ticks.to;
            auto look = this->look(index, weathers_[weather], ends);
            if (++weather == weathers_.size()) {
                weather = 0;
                index += ticks.every;
                progress.update(++done);
            }
            if (look)
                return look;
        }
        return nullptr;
    });
    progress.clear();
    if (!due_)
        refuse_gap(ticks);
    if (!carried_)
        throw world::Error("no vehicle to mount the camera on in these ticks of " +
                           trace_.path().string());
}

}  // namespace reprise::cli
