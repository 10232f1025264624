#include "cli/pictures/cameras.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "cli/pictures/recorded_rig.h"
#include "cli/pictures/rig_file.h"
#include "cli/pictures/told.h"
#include "replay/table/actor_search.h"
#include "world/check.h"
#include "world/external/sensor_attributes.h"
#include "world/models/actors.h"
#include "world/models/viewpoint.h"

namespace reprise::cli {

namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr double around = 4;  // [s] before and behind what is shown, that a preset looks at

world::SensorRig make_rig(const RenderOptions& options) {
    constexpr double usual_fov_deg = 90;
    world::SensorRig rig;
    for (const std::string& camera : options.cameras) {
        world::SensorSpec sensor;
        sensor.name = camera;
        sensor.kind = *world::find_camera_kind(camera);
        sensor.width = options.width;
        sensor.height = options.height;
        sensor.fov = options.fov_deg.value_or(usual_fov_deg) * radians;
        sensor.position = {options.mount[0], options.mount[1], options.mount[2]};
        sensor.pitch = options.pitch_deg * radians;
        sensor.yaw = options.yaw_deg * radians;
        tell(sensor, options.attributes);
        rig.push_back(sensor);
    }
    return rig;
}

render::PresetWish wish_of(const RenderOptions& options) {
    using enum render::Preset;
    render::PresetWish wish;
    wish.preset = options.preset == "top"      ? top
                  : options.preset == "driver" ? driver
                  : options.preset == "orbit"  ? orbit
                                               : chase;
    if (options.fov_deg)
        wish.fov = *options.fov_deg * radians;
    wish.distance = options.distance;
    wish.heading_up = options.heading_up;
    return wish;
}

world::Viewpoint eye_of(const world::TickView& tick, std::uint32_t actor) {
    if (const world::VehicleState* vehicle = world::find(tick.vehicles(), actor))
        return world::drivers_eye(world::vehicle_models()[vehicle->model()]);
    if (const world::CarState* car = world::find(tick.cars(), actor))
        return world::drivers_eye(world::vehicle_models()[car->model()]);
    const world::WalkerState* walker = world::find(tick.walkers(), actor);
    REPRISE_CHECK(walker != nullptr, std::to_string(actor));
    return world::walkers_eye(world::walker_models()[walker->model()]);
}

}  // namespace

Cameras::Cameras(const RenderOptions& options, replay::TraceReader& trace, const Ticks& ticks)
    : options_(options),
      usual_(trace.episode()) {
    if (!options.actor.empty())
        named_ = replay::find_actor(trace, options.actor);
    if (options.recorded_rig)
        recorded_ = recorded_rig(trace, named_.value_or(0), ticks.to);
    if (recorded_)
        recorded_ = only({std::move(*recorded_), {}, {}}, /*cameras=*/true).rig;
    if (!options.rig.empty())
        read_rig(trace);
    sensors_ = recorded_ ? recorded_->sensors : make_rig(options);
    if (options.own_car)
        for (world::SensorSpec& sensor : sensors_)
            if (world::attribute(sensor, "own_car") == 0)
                sensor.attributes.push_back({"own_car", 1});
    for (world::SensorSpec& sensor : sensors_)
        sensor.step = static_cast<double>(trace.episode().step_ns) * 1e-9;
    if (!options.preset.empty())
        follow(trace, ticks);
}

void Cameras::read_rig(replay::TraceReader& trace) {
    RigFile file = only(read_rig_file(options_.rig, trace), /*cameras=*/true);
    carriers_ = std::move(file.carriers);
    carrier_ids_ = std::move(file.carrier_ids);
    recorded_ = std::move(file.rig);
}

std::string Cameras::carrier(std::size_t sensor) const {
    if (!carriers_.empty() && !carriers_[sensor].empty())
        return carriers_[sensor];
    if (!options_.actor.empty())
        return options_.actor;
    return recorded_ && carrier_ids_.empty() ? std::to_string(recorded_->sensors.front().actor)
                                             : "the first vehicle";
}

bool Cameras::see_motion() const {
    return world::see_motion(sensors_);
}

bool Cameras::is_there(std::size_t sensor, const world::TickView& tick) const {
    if (carrier_ids_.empty() || !carrier_ids_[sensor])
        return true;
    return *carrier_ids_[sensor] == 0 || world::find_pose(tick, *carrier_ids_[sensor]);
}

/// Whom a preset follows all the way: who was named, or the first vehicle that is there.
std::uint32_t Cameras::followed(replay::TraceReader& trace, const Ticks& ticks) const {
    if (named_)
        return *named_;
    for (std::uint64_t index = ticks.from; index <= ticks.to; ++index) {
        if (const auto usual = usual_.in(trace.tick(index).view))
            return *usual;
    }
    throw world::Error(trace.path().string() +
                       ": no vehicle with mass in these ticks; say with --actor whom to look at");
}

void Cameras::follow(replay::TraceReader& trace, const Ticks& ticks) {
    render::Track track;
    track.actor = followed(trace, ticks);
    track.step = static_cast<double>(trace.episode().step_ns) * 1e-9;
    const auto reach = static_cast<std::uint64_t>(around / track.step);
    const std::uint64_t first = std::max(trace.first(), ticks.from - std::min(ticks.from, reach));
    const std::uint64_t last = std::min(trace.last(), ticks.to + reach);
    for (std::uint64_t index = first; index <= last; ++index) {
        const world::TickView tick = trace.tick(index).view;
        const auto pose = world::find_pose(tick, track.actor);
        if (!pose && track.poses.empty())
            continue;
        if (!pose)
            break;
        if (track.poses.empty()) {
            track.first = index;
            track.extent = *world::find_extent(tick, track.actor);
            track.eye = eye_of(tick, track.actor);
        }
        track.poses.push_back(*pose);
    }
    if (track.poses.empty())
        throw world::Error(fmt::format("{}: actor {} is not there in ticks {} to {}",
                                       trace.path().string(),
                                       options_.actor,
                                       ticks.from,
                                       ticks.to));
    preset_first_ = track.first;
    preset_last_ = track.last();
    preset_.emplace(wish_of(options_), std::move(track), trace.recording().town);
}

std::vector<std::size_t> Cameras::due(std::uint64_t tick) const {
    if (recorded_ && options_.every.empty())
        return recorded_->due(tick);
    std::vector<std::size_t> all(sensors_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

std::optional<std::uint32_t> Cameras::actor(const world::TickView& tick) const {
    if (preset_) {
        const bool looks_on = options_.preset != "driver";
        const bool there =
            tick.index() >= preset_first_ && (looks_on || tick.index() <= preset_last_);
        return there ? std::optional(preset_->track().actor) : std::nullopt;
    }
    if (recorded_ && carrier_ids_.empty()) {
        const std::uint32_t carrier = recorded_->sensors.front().actor;
        return world::find(tick.vehicles(), carrier) == nullptr ? std::nullopt
                                                                : std::optional(carrier);
    }
    if (named_)
        return world::find_pose(tick, *named_) ? named_ : std::nullopt;
    if (const auto usual = usual_.in(tick))
        return usual;
    // A rig's sensors may all have carriers of their own.
    const bool all_named =
        !carrier_ids_.empty() && std::all_of(carrier_ids_.begin(), carrier_ids_.end(), [](auto id) {
            return id.has_value();
        });
    return all_named ? std::optional(0U) : std::nullopt;
}

world::SensorSpec Cameras::placed(std::size_t sensor,
                                  std::uint32_t actor,
                                  const world::TickView& tick) const {
    if (preset_)
        return preset_->at(tick.index(), sensors_[sensor]);
    world::SensorSpec mounted = sensors_[sensor];
    mounted.actor = carrier_ids_.empty() ? actor : carrier_ids_[sensor].value_or(actor);
    return mounted;
}

}  // namespace reprise::cli
