// What it must do: events as a function of two recorded ticks, though a real pixel remembers the
//   brightness of its last event.
// How it goes: levels of brightness stand at fixed places, a threshold apart, another place for
// each
//   pixel. A pixel makes an event where its brightness crosses one. So what ticks find adds up over
//   ticks: slow changes are noticed, and each frame alone is the same as in sequence.
// What it assumes: pictures in order of time.
// What it keeps: nothing.
#include "render/optics/events.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <tbb/parallel_for.h>

#include "render/trace/default_float_mode.h"
#include "world/external/sensor_attributes.h"
#include "world/external/sensor_noise.h"

namespace reprise::render {

namespace {

struct Thresholds {
    double rising;
    double falling;
    double blind_ns;
};

/// One pixel's way through the pictures.
class PixelWatch {
  public:
    PixelWatch(const Thresholds& thresholds, double phase, std::vector<world::PixelEvent>& events)
        : thresholds_(thresholds),
          phase_(phase),
          events_(events) {}

    void stand_at(int x, int y) {
        x_ = x;
        y_ = y;
    }

    void go(double from, double to, std::int64_t start_ns, std::int64_t end_ns) {
        if (from == to)
            return;
        const bool rising = to > from;
        const double threshold = rising ? thresholds_.rising : thresholds_.falling;
        const auto level = [&](double log) { return std::floor(log / threshold - phase_); };
        const double first = level(from);
        const double last = level(to);
        const auto count = static_cast<int>(std::abs(last - first));
        for (int i = 0; i < count; ++i) {
            const double crossed = rising ? first + 1 + i : first - i;
            const double share = ((crossed + phase_) * threshold - from) / (to - from);
            note(start_ns + static_cast<std::int64_t>(std::clamp(share, 0.0, 1.0) *
                                                      static_cast<double>(end_ns - start_ns)),
                 rising);
        }
    }

  private:
    void note(std::int64_t time_ns, bool rising) {
        if (noticed_ && static_cast<double>(time_ns - last_ns_) < thresholds_.blind_ns)
            return;
        noticed_ = true;
        last_ns_ = time_ns;
        events_.push_back(
            {time_ns, static_cast<std::uint16_t>(x_), static_cast<std::uint16_t>(y_), rising});
    }

    const Thresholds& thresholds_;
    double phase_;
    std::vector<world::PixelEvent>& events_;
    int x_ = 0;
    int y_ = 0;
    bool noticed_ = false;
    std::int64_t last_ns_ = 0;
};

}  // namespace

LogPicture log_picture(const Frame& frame, double log_eps, std::int64_t time_ns) {
    LogPicture picture{time_ns, std::vector<float>(frame.colors.size())};
    tbb::parallel_for(0, frame.height, [&](int y) {
        const DefaultFloatMode plain;
        for (int x = 0; x < frame.width; ++x) {
            const std::size_t i = frame.index(x, y);
            const auto light = static_cast<double>(std::max(0.0F, luminance(frame.colors[i])));
            picture.logs[i] = static_cast<float>(std::log(log_eps + light));
        }
    });
    return picture;
}

void find_events(const world::SensorSpec& spec,
                 const std::vector<LogPicture>& pictures,
                 world::SensorFrame& frame) {
    frame.data.assign(world::bytes_of(frame.type) * 2 * static_cast<std::size_t>(frame.width) *
                          static_cast<std::size_t>(frame.height),
                      0);
    const Thresholds thresholds{world::attribute(spec, "positive_threshold"),
                                world::attribute(spec, "negative_threshold"),
                                world::attribute(spec, "refractory_period_ns")};
    const world::SensorNoise phases(
        static_cast<std::uint64_t>(world::attribute(spec, "noise_seed")), spec.name, 0);
    std::vector<std::vector<world::PixelEvent>> rows(static_cast<std::size_t>(frame.height));
    tbb::parallel_for(0, frame.height, [&](int y) {
        const DefaultFloatMode plain;
        for (int x = 0; x < frame.width; ++x) {
            const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                               static_cast<std::size_t>(x);
            PixelWatch watch(
                thresholds, phases.uniform(pixel, 0), rows[static_cast<std::size_t>(y)]);
            watch.stand_at(x, y);
            for (std::size_t i = 0; i + 1 < pictures.size(); ++i)
                watch.go(static_cast<double>(pictures[i].logs[pixel]),
                         static_cast<double>(pictures[i + 1].logs[pixel]),
                         pictures[i].time_ns,
                         pictures[i + 1].time_ns);
        }
    });
    // A town that a car drives through makes a million in a tick: they are not held twice.
    std::size_t count = 0;
    for (const auto& row : rows)
        count += row.size();
    frame.events.reserve(count);
    for (auto& row : rows) {
        frame.events.insert(frame.events.end(), row.begin(), row.end());
        row = {};
    }
    std::sort(frame.events.begin(),
              frame.events.end(),
              [](const world::PixelEvent& one, const world::PixelEvent& other) {
                  return std::tuple(one.time_ns, one.y, one.x, one.rising) <
                         std::tuple(other.time_ns, other.y, other.x, other.rising);
              });
    for (const world::PixelEvent& event : frame.events) {
        const std::size_t pixel =
            static_cast<std::size_t>(event.y) * static_cast<std::size_t>(frame.width) + event.x;
        std::uint8_t& count = frame.data[2 * pixel + (event.rising ? 0 : 1)];
        count = static_cast<std::uint8_t>(std::min(255, count + 1));
    }
}

}  // namespace reprise::render
