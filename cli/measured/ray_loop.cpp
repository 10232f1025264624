#include "cli/measured/ray_loop.h"

#include "cli/pictures/kept_ticks.h"

namespace reprise::cli {

namespace {

/// Keeps its tick: the trace is read on meanwhile.
class Look : public render::Observation {
  public:
    Look(const replay::RecordedTick& tick, RayOutput& output) : tick_(tick), output_(output) {}

    world::TickView tick() const override { return tick_.view(); }

    const world::SensorRig& rig() const override { return rig_; }

    const world::Weather& weather() const override { return weather_; }

    void add(std::size_t number, world::SensorSpec placed) {
        numbers_.push_back(number);
        rig_.push_back(std::move(placed));
    }

    void set(const world::Weather& weather) { weather_ = weather; }

    void seen(std::vector<world::SensorFrame> frames) override {
        for (std::size_t i = 0; i < frames.size(); ++i)
            output_.take(numbers_[i], tick(), rig_[i], std::move(frames[i]));
    }

  private:
    KeptTick tick_;
    RayOutput& output_;
    std::vector<std::size_t> numbers_;
    world::SensorRig rig_;
    world::Weather weather_;
};

}  // namespace

void look_by_rays(const MeasuredRig& rig,
                  replay::TraceReader& trace,
                  const Ticks& ticks,
                  const ChosenWeather& weather,
                  render::Sensors& sensors,
                  RayOutput& output) {
    std::uint64_t index = ticks.from;
    sensors.observe_each([&]() -> std::unique_ptr<render::Observation> {
        for (; index <= ticks.to; ++index) {
            auto look = std::make_unique<Look>(trace.tick(index), output);
            for (const auto& [i, actor] : rig.carriers(look->tick()))
                if (world::is_ranging(rig.sensors()[i].kind) && rig.is_due(i, index) &&
                    output.wants(i, index))
                    look->add(i, rig.placed(i, actor));
            if (look->rig().empty())
                continue;
            look->set(weather.at(look->tick()));
            ++index;
            return look;
        }
        return nullptr;
    });
}

}  // namespace reprise::cli
