#include "cli/live.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>

#include "cli/measured/tick_readings.h"
#include "cli/process/guard.h"
#include "remote/live_rig.h"
#include "render/sensors.h"

namespace reprise::cli {

namespace {

/// Makes what it is asked for, as `reprise render` does of a trace.
class Maker {
  public:
    explicit Maker(const remote::LivePictures& pictures) {
        const world::SensorRig& rig = pictures.sensors();
        // The town takes seconds to build, and sensors without rays do not look at it.
        if (!std::all_of(rig.begin(), rig.end(), is_reading))
            sensors_.emplace(pictures.town());
        if (std::any_of(rig.begin(), rig.end(), is_reading))
            readings_.emplace(pictures.town(), pictures.network());
    }

    std::vector<world::SensorFrame> make(const remote::LivePictures::Wish& wish) {
        world::SensorRig seeing;
        std::copy_if(wish.sensors.begin(),
                     wish.sensors.end(),
                     std::back_inserter(seeing),
                     std::not_fn(is_reading));
        std::vector<world::SensorFrame> seen;
        if (!seeing.empty()) {
            render::Neighbours neighbours;
            if (wish.last)
                neighbours.last = render::Neighbour{*wish.last, {}};
            seen = sensors_->observe(wish.tick, seeing, *wish.tick.tick->weather(), neighbours);
        }
        std::vector<world::SensorFrame> frames;
        auto next = seen.begin();
        for (const world::SensorSpec& sensor : wish.sensors)
            frames.push_back(is_reading(sensor) ? read(wish, sensor) : std::move(*next++));
        return frames;
    }

  private:
    static bool is_reading(const world::SensorSpec& sensor) {
        return world::is_reading(sensor.kind);
    }

    /// Rows of doubles.
    world::SensorFrame read(const remote::LivePictures::Wish& wish,
                            const world::SensorSpec& sensor) {
        world::SensorFrame frame;
        frame.name = sensor.name;
        frame.kind = sensor.kind;
        frame.tick = wish.tick.index();
        for (const world::Reading& row :
             readings_->read(wish.last ? &*wish.last : nullptr, wish.tick, sensor)) {
            const auto* bytes = reinterpret_cast<const std::uint8_t*>(row.data());
            frame.data.insert(frame.data.end(), bytes, bytes + row.size() * sizeof(double));
        }
        return frame;
    }

    std::optional<render::Sensors> sensors_;
    std::optional<TickReadings> readings_;
};

}  // namespace

int live() {
    try {
        remote::LivePictures pictures;
        Maker maker(pictures);
        pictures.ready();
        for (;;)
            pictures.show(maker.make(pictures.next()));
    } catch (const remote::ChannelFault&) {
        // The run ended, and says why; nobody looks any more.
    }
    return exit_good;
}

}  // namespace reprise::cli
