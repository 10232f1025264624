#include "cli/measured/measured_rig.h"

#include <fmt/format.h>

#include "cli/pictures/recorded_rig.h"
#include "cli/pictures/rig_file.h"
#include "cli/pictures/told.h"
#include "replay/table/actor_search.h"
#include "world/external/sensor_attributes.h"
#include "world/models/actors.h"
#include "world/units.h"

namespace reprise::cli {

namespace {

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

}  // namespace

MeasuredRig::MeasuredRig(const RenderOptions& options,
                         replay::TraceReader& trace,
                         const Ticks& ticks)
    : options_(options),
      trace_(trace),
      ticks_(ticks),
      usual_(trace.episode()) {
    look_up_rig();
    const auto every = static_cast<std::uint32_t>(ticks.every);
    const bool has_periods = options.recorded_rig || !options.rig.empty();
    if (!has_periods || !options.every.empty()) {
        rig_.every.clear();
        for (const world::SensorSpec& sensor : rig_.sensors)
            // Pictures a second apart are usual, but tables have a row for each tick.
            rig_.every.push_back(options.every.empty() && has_table(sensor.kind) ? 1 : every);
        rig_.since = ticks.from;
    }
    for (std::size_t i = 0; i < rig_.sensors.size(); ++i) {
        rig_.sensors[i].step = static_cast<double>(trace.episode().step_ns) * 1e-9;
        rig_.sensors[i].every = rig_.every[i];
    }
}

void MeasuredRig::look_up_rig() {
    if (!options_.actor.empty())
        named_ = replay::find_actor(trace_, options_.actor);
    if (!options_.rig.empty()) {
        RigFile file = only(read_rig_file(options_.rig, trace_), /*cameras=*/false);
        rig_ = std::move(file.rig);
        carriers_ = std::move(file.carriers);
        carrier_ids_ = std::move(file.carrier_ids);
    } else if (!options_.recorded_rig) {
        rig_.sensors = named_rig(options_);
    } else if (auto recorded = recorded_rig(trace_, named_.value_or(0), ticks_.to)) {
        rig_ = only({std::move(*recorded), {}, {}}, /*cameras=*/false).rig;
    }
}

std::string MeasuredRig::names() const {
    std::vector<std::string> names;
    for (const world::SensorSpec& sensor : rig_.sensors)
        names.push_back(sensor.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

void MeasuredRig::add_semantic_twin(std::size_t lidar) {
    world::SensorSpec twin = rig_.sensors[lidar];
    twin.kind = world::SensorKind::semantic_lidar;
    std::erase_if(twin.attributes, [&](const world::AttributeValue& one) {
        return world::find_attribute(twin.kind, one.name) == nullptr;
    });
    rig_.sensors.push_back(std::move(twin));
    rig_.every.push_back(rig_.every[lidar]);
    if (carrier_ids_.empty())
        return;
    carriers_.push_back(carriers_[lidar]);
    carrier_ids_.push_back(carrier_ids_[lidar]);
}

std::string MeasuredRig::mounted_on(std::size_t sensor) const {
    if (!carriers_.empty() && !carriers_[sensor].empty())
        return carriers_[sensor];
    if (!options_.actor.empty())
        return options_.actor;
    return options_.recorded_rig ? std::to_string(rig_.sensors.front().actor) : "the first vehicle";
}

/// Whom a rig file says, 0 for the world; of a recorded rig who carried it; else who was named, or
/// who usually does.
std::optional<std::uint32_t> MeasuredRig::carrier(std::size_t sensor,
                                                  const world::TickView& tick) const {
    std::uint32_t actor = named_.value_or(0);
    if (!carrier_ids_.empty() && carrier_ids_[sensor]) {
        actor = *carrier_ids_[sensor];
        if (actor == 0)
            return actor;
    } else if (options_.recorded_rig) {
        actor = rig_.sensors.front().actor;
    } else if (!named_) {
        actor = usual_.in(tick).value_or(0);
    }
    return actor != 0 && world::find_pose(tick, actor) ? std::optional(actor) : std::nullopt;
}

std::map<std::size_t, std::uint32_t> MeasuredRig::carriers(const world::TickView& tick) const {
    std::map<std::size_t, std::uint32_t> found;
    for (std::size_t i = 0; i < rig_.sensors.size(); ++i)
        if (const auto actor = carrier(i, tick))
            found.emplace(i, *actor);
    return found;
}

world::SensorSpec MeasuredRig::placed(std::size_t sensor, std::uint32_t actor) const {
    world::SensorSpec spec = rig_.sensors[sensor];
    spec.actor = actor;
    return spec;
}

}  // namespace reprise::cli
