// What it must do: write what a vehicle's sensors measured that are no cameras.
// How it goes: sensors without rays read tick after tick; the others look at several ticks at once,
//   as cameras do, and write a file for each.
#include "cli/pictures/measurements.h"

#include <algorithm>
#include <cstring>
#include <list>
#include <mutex>
#include <numbers>

#include <fmt/format.h>

#include "cli/pictures/chosen_weather.h"
#include "cli/pictures/reading_file.h"
#include "cli/pictures/recorded_rig.h"
#include "cli/pictures/rig_file.h"
#include "cli/pictures/tick_readings.h"
#include "cli/pictures/told.h"
#include "cli/process/new_folder.h"
#include "render/point_file.h"
#include "replay/table/actor_search.h"
#include "world/check.h"
#include "world/external/sensor_attributes.h"
#include "world/models/actors.h"
#include "world/units.h"

namespace reprise::cli {

namespace {

using world::SensorKind;

/// As options say: each kind once, all in one place.
world::SensorRig named_rig(const RenderOptions& options) {
    world::SensorRig rig;
    for (const std::string& kind : options.measured) {
        world::SensorSpec sensor;
        sensor.name = kind;
        sensor.kind = *world::find_sensor_kind(kind);
        sensor.position = {options.mount[0], options.mount[1], options.mount[2]};
        sensor.pitch = options.pitch_deg * world::degree;
        sensor.yaw = options.yaw_deg * world::degree;
        tell(sensor, options.attributes);
        rig.push_back(std::move(sensor));
    }
    return rig;
}

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
class Files {
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
            folders_.push_back(alone || has_table(sensor.kind) ? root_ : root_ / sensor.name);
            names_.push_back(sensor.name);
            kinds_.push_back(sensor.kind);
            made_.emplace_front(folders_.back());
        }
    }

    /// One table for all ticks; others have a file for each.
    static bool has_table(SensorKind kind) {
        return world::is_reading(kind) || kind == SensorKind::obstacle;
    }

    /// From any thread.
    void take(std::size_t sensor, const world::SensorFrame& frame) {
        if (!has_table(frame.kind)) {
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
            if (has_table(kinds_[i])) {
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

/// Keeps its tick: the trace is read on meanwhile.
class Look : public render::Observation {
  public:
    Look(const replay::RecordedTick& tick, Files& files)
        : tick_bytes_(tick.tick_bytes.begin(), tick.tick_bytes.end()),
          traffic_bytes_(tick.traffic_bytes.begin(), tick.traffic_bytes.end()),
          files_(files) {}

    world::TickView tick() const override {
        return {world::GetTick(tick_bytes_.data()), world::GetTraffic(traffic_bytes_.data())};
    }

    const world::SensorRig& rig() const override { return rig_; }

    const world::Weather& weather() const override { return weather_; }

    void add(std::size_t number, const world::SensorSpec& sensor) {
        numbers_.push_back(number);
        rig_.push_back(sensor);
    }

    void set(const world::Weather& weather) { weather_ = weather; }

    void seen(std::vector<world::SensorFrame> frames) override {
        for (std::size_t i = 0; i < frames.size(); ++i)
            files_.take(numbers_[i], frames[i]);
    }

  private:
    std::vector<std::uint8_t> tick_bytes_;
    std::vector<std::uint8_t> traffic_bytes_;
    Files& files_;
    std::vector<std::size_t> numbers_;
    world::SensorRig rig_;
    world::Weather weather_;
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
      ticks_(ticks) {
    look_up_rig();
    const auto every = static_cast<std::uint32_t>(ticks.every);
    const bool has_periods = options.recorded_rig || !options.rig.empty();
    if (!has_periods || !options.every.empty()) {
        rig_.every.clear();
        for (const world::SensorSpec& sensor : rig_.sensors)
            // Pictures a second apart are usual, but tables have a row for each tick.
            rig_.every.push_back(options.every.empty() && Files::has_table(sensor.kind) ? 1
                                                                                        : every);
        rig_.since = ticks.from;
    }
    for (std::size_t i = 0; i < rig_.sensors.size(); ++i) {
        rig_.sensors[i].step = static_cast<double>(trace.episode().step_ns) * 1e-9;
        rig_.sensors[i].every = rig_.every[i];
    }
}

void Measurements::look_up_rig() {
    if (!options_.actor.empty())
        named_ = replay::find_actor(trace_, options_.actor);
    if (!options_.rig.empty()) {
        RigFile file = only(read_rig_file(options_.rig, trace_), /*cameras=*/false);
        rig_ = std::move(file.rig);
        carrier_ids_ = std::move(file.carrier_ids);
    } else if (!options_.recorded_rig) {
        rig_.sensors = named_rig(options_);
    } else if (auto recorded = recorded_rig(trace_, named_.value_or(0), ticks_.to)) {
        rig_ = only({std::move(*recorded), {}, {}}, /*cameras=*/false).rig;
    }
}

std::string Measurements::names() const {
    std::vector<std::string> names;
    for (const world::SensorSpec& sensor : rig_.sensors)
        names.push_back(sensor.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Whom a rig file says, 0 for the world; of a recorded rig who carried it; else who was named, or
/// the first vehicle with mass.
std::optional<std::uint32_t> Measurements::carrier(std::size_t sensor,
                                                   const world::TickView& tick) const {
    std::uint32_t actor = named_.value_or(0);
    if (!carrier_ids_.empty() && carrier_ids_[sensor]) {
        actor = *carrier_ids_[sensor];
        if (actor == 0)
            return actor;
    } else if (options_.recorded_rig) {
        actor = rig_.sensors.front().actor;
    } else if (!named_ && !tick.vehicles().empty()) {
        actor = tick.vehicles().front().id();
    }
    return actor != 0 && world::find_pose(tick, actor) ? std::optional(actor) : std::nullopt;
}

std::map<std::size_t, std::uint32_t> Measurements::carriers(const world::TickView& tick) const {
    std::map<std::size_t, std::uint32_t> found;
    for (std::size_t i = 0; i < rig_.sensors.size(); ++i)
        if (const auto actor = carrier(i, tick))
            found.emplace(i, *actor);
    return found;
}

std::size_t Measurements::write(const std::function<render::Sensors&()>& sensors,
                                WrittenFiles& written) {
    const double step = static_cast<double>(trace_.episode().step_ns) * 1e-9;
    Files files(options_, rig_.sensors, step, written);
    const bool has_rays =
        std::any_of(rig_.sensors.begin(), rig_.sensors.end(), [](const world::SensorSpec& sensor) {
            return world::is_ranging(sensor.kind);
        });
    Reader reader(trace_, files);
    bool carried = false;
    // Who carries them may be another one in the next tick.
    const auto placed = [&](std::size_t i, std::uint32_t actor) {
        world::SensorSpec sensor = rig_.sensors[i];
        sensor.actor = actor;
        return sensor;
    };
    for (std::uint64_t index = ticks_.from; index <= ticks_.to; ++index)
        for (const auto& [i, actor] : carriers(trace_.tick(index).view)) {
            carried = true;
            if (world::is_reading(rig_.sensors[i].kind))
                reader.read(i, placed(i, actor), index, rig_.is_due(i, index));
        }
    if (!carried)
        throw world::Error("no vehicle to mount the sensors on in these ticks of " +
                           options_.trace);
    const ChosenWeather weather(options_.weather, step);
    std::uint64_t index = ticks_.from;
    if (has_rays)
        sensors().observe_each([&]() -> std::unique_ptr<render::Observation> {
            for (; index <= ticks_.to; ++index) {
                auto look = std::make_unique<Look>(trace_.tick(index), files);
                for (const auto& [i, actor] : carriers(look->tick()))
                    if (world::is_ranging(rig_.sensors[i].kind) && rig_.is_due(i, index))
                        look->add(i, placed(i, actor));
                if (look->rig().empty())
                    continue;
                look->set(weather.at(look->tick()));
                ++index;
                return look;
            }
            return nullptr;
        });
    return files.finish();
}

}  // namespace reprise::cli
