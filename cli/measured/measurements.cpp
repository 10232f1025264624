// What it must do: write what a vehicle's sensors measured that are no cameras.
// How it goes: sensors without rays read tick after tick; the others look at several ticks at once,
//   as cameras do, and write a file for each.
#include "cli/measured/measurements.h"

#include <algorithm>
#include <cstring>
#include <list>
#include <mutex>

#include <fmt/format.h>

#include "cli/measured/ray_loop.h"
#include "cli/measured/reading_file.h"
#include "cli/measured/tick_readings.h"
#include "cli/process/new_folder.h"
#include "render/point_file.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

using world::SensorKind;

render::PointFormat format_of(const std::string& name) {
    return name == "pcd"   ? render::PointFormat::pcd
           : name == "bin" ? render::PointFormat::bin
           : name == "npy" ? render::PointFormat::npy
                           : render::PointFormat::ply;
}

/// The row of an obstacle's frame, as a reading.
world::Reading reading_of(const world::SensorFrame& frame) {
    std::uint32_t other = 0;
    float distance = 0;
    std::memcpy(&other, frame.data.data(), sizeof(other));
    std::memcpy(&distance, frame.data.data() + sizeof(other), sizeof(distance));
    return {static_cast<double>(other), static_cast<double>(distance)};
}

/// Where all of it goes.
class Files : public RayOutput {
  public:
    Files(const RenderOptions& options,
          const world::SensorRig& rig,
          double step,
          WrittenFiles& written)
        : options_(options),
          root_(options.output),
          written_(written) {
        for (const world::SensorSpec& sensor : rig) {
            tables_.emplace_back(sensor.kind, step);
            const bool alone = rig.size() == 1 && options.measured.size() == 1;
            folders_.push_back(alone || MeasuredRig::has_table(sensor.kind) ? root_
                                                                            : root_ / sensor.name);
            names_.push_back(sensor.name);
            kinds_.push_back(sensor.kind);
            made_.emplace_front(folders_.back());
        }
    }

    /// From any thread.
    void take(std::size_t sensor,
              const world::TickView& /*tick*/,
              const world::SensorSpec& /*placed*/,
              world::SensorFrame frame) override {
        if (!MeasuredRig::has_table(frame.kind)) {
            const std::filesystem::path path =
                folders_[sensor] / fmt::format("{:06}.{}", frame.tick, options_.points);
            written_.add(path);
            render::write_points(frame, path, format_of(options_.points));
        } else if (frame.height > 0) {
            read(sensor, frame.tick, reading_of(frame));
        }
        const std::lock_guard hold(lock_);
        ++frames_;
    }

    void read(std::size_t sensor, std::uint64_t tick, world::Reading reading) {
        const std::lock_guard hold(lock_);
        tables_[sensor].add(tick, std::move(reading));
    }

    /// How many there are.
    std::size_t finish() {
        for (std::size_t i = 0; i < tables_.size(); ++i)
            if (MeasuredRig::has_table(kinds_[i])) {
                const std::filesystem::path path = root_ / (names_[i] + "." + options_.readings);
                written_.add(path);
                tables_[i].write(path);
                if (world::is_reading(kinds_[i]))
                    frames_ += tables_[i].count();
            }
        return frames_;
    }

  private:
    const RenderOptions& options_;
    std::filesystem::path root_;
    WrittenFiles& written_;
    std::vector<ReadingFile> tables_;
    std::vector<std::filesystem::path> folders_;
    std::vector<std::string> names_;
    std::vector<SensorKind> kinds_;
    std::list<NewFolder> made_;
    std::mutex lock_;
    std::size_t frames_ = 0;
};

/// Of sensors without rays: they look at each tick, as what happens does not wait for them.
class Reader {
  public:
    Reader(replay::TraceReader& trace, Files& files)
        : trace_(trace),
          files_(files),
          readings_(trace.recording().town, trace.recording().network) {}

    void read(std::size_t number, const world::SensorSpec& spec, std::uint64_t index, bool due) {
        advance(index);
        const world::TickView last = last_.view();
        for (world::Reading& reading :
             readings_.read(last_.tick.empty() ? nullptr : &last, tick_.view(), spec, due))
            files_.read(number, index, std::move(reading));
    }

  private:
    struct Kept {
        std::vector<std::uint8_t> tick;
        std::vector<std::uint8_t> traffic;

        std::uint64_t index() const { return tick.empty() ? 0 : view().index(); }

        world::TickView view() const {
            if (tick.empty())
                return {};
            return {world::GetTick(tick.data()), world::GetTraffic(traffic.data())};
        }
    };

    void advance(std::uint64_t index) {
        if (tick_.index() == index)
            return;
        if (!tick_.tick.empty() && tick_.index() + 1 == index)
            std::swap(last_, tick_);
        else if (index > trace_.first())
            fill(last_, index - 1);
        fill(tick_, index);
    }

    void fill(Kept& kept, std::uint64_t index) {
        const replay::RecordedTick read = trace_.tick(index);
        kept.tick.assign(read.tick_bytes.begin(), read.tick_bytes.end());
        kept.traffic.assign(read.traffic_bytes.begin(), read.traffic_bytes.end());
    }

    replay::TraceReader& trace_;
    Files& files_;
    TickReadings readings_;
    Kept tick_;
    Kept last_;
};

}  // namespace

Measurements::Measurements(const RenderOptions& options,
                           replay::TraceReader& trace,
                           const Ticks& ticks)
    : options_(options),
      trace_(trace),
      ticks_(ticks),
      rig_(options, trace, ticks) {}

std::size_t Measurements::write(const std::function<render::Sensors&()>& sensors,
                                WrittenFiles& written) {
    const double step = static_cast<double>(trace_.episode().step_ns) * 1e-9;
    Files files(options_, rig_.sensors(), step, written);
    Reader reader(trace_, files);
    bool carried = false;
    for (std::uint64_t index = ticks_.from; index <= ticks_.to; ++index)
        for (const auto& [i, actor] : rig_.carriers(trace_.tick(index).view)) {
            carried = true;
            if (world::is_reading(rig_.sensors()[i].kind))
                reader.read(i, rig_.placed(i, actor), index, rig_.is_due(i, index));
        }
    if (!carried)
        throw world::Error("no vehicle to mount the sensors on in these ticks of " +
                           options_.trace);
    const bool has_rays = std::any_of(
        rig_.sensors().begin(), rig_.sensors().end(), [](const world::SensorSpec& sensor) {
            return world::is_ranging(sensor.kind);
        });
    if (has_rays)
        look_by_rays(rig_, trace_, ticks_, ChosenWeather(options_.weather, step), sensors(), files);
    return files.finish();
}

}  // namespace reprise::cli
