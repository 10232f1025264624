#include "kernel/nudger.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "kernel/drill/real_fields.h"
#include "kernel/pedestrians.h"
#include "kernel/physics/physics.h"
#include "kernel/roster.h"
#include "world/check.h"

namespace reprise::kernel {

/// A struct of the record and whose it is.
struct Nudger::Row {
    const flatbuffers::TypeTable* type;
    void* bytes;
    std::uint32_t actor;
    std::string prefix;
};

namespace {

template <typename T>
void* bytes_of(T& value) {
    return static_cast<void*>(&value);
}

}  // namespace

/// Remembers who is called what on the way there.
bool Nudger::is_due(const world::TickDraft& next) {
    if (!nudge_ || next.tick.index > nudge_->tick)
        return false;
    for (const world::EventT& event : next.tick.events)
        if (event.kind == world::EventKind::spawned && event.actor < world::first_background_id)
            names_[event.actor] = event.text;
    return next.tick.index == nudge_->tick;
}

std::optional<std::uint32_t> Nudger::wanted_actor() const {
    std::optional<std::uint32_t> found;
    for (const auto& [id, name] : names_)
        if (name == nudge_->actor)
            found = id;  // the newest of that name
    return found ? found : whole<std::uint32_t>(nudge_->actor);
}

/// True when the row was what the nudge is about; then it is done.
bool Nudger::move(const Row& row) {
    if (!nudge_->actor.empty() && (row.actor == 0 || wanted_actor() != row.actor))
        return false;
    const std::vector<RealField> numbers = real_fields(*row.type, row.prefix);
    const auto number =
        std::find_if(numbers.begin(), numbers.end(), [&](const RealField& candidate) {
            return candidate.path == nudge_->field;
        });
    if (number == numbers.end())
        return false;
    const auto change = [&](auto value) {
        auto* at = static_cast<std::uint8_t*>(row.bytes) + number->offset;
        std::memcpy(&value, at, sizeof(value));
        using Bits = std::conditional_t<sizeof(value) == 8, std::int64_t, std::int32_t>;
        nudge_->units = units_for(value, nudge_->units);
        value = moved<Bits>(value, nudge_->units);
        std::memcpy(at, &value, sizeof(value));
    };
    if (number->is_double)
        change(double{});
    else
        change(float{});
    return true;
}

/// Friction is a number of the tick itself, in no struct of the record.
bool Nudger::move_road_friction(world::TickDraft& next) const {
    if (!nudge_->actor.empty() || nudge_->field != "road_friction")
        return false;
    next.tick.road_friction = moved_by_units(next.tick.road_friction, nudge_->units);
    return true;
}

/// The structs that this stage wrote.
std::vector<Nudger::Row> Nudger::rows_of(Stage stage, world::TickDraft& next) {
    std::vector<Row> rows;
    switch (stage) {
        case Stage::scenario:
            rows.push_back({world::WeatherTypeTable(), bytes_of(next.tick.weather), 0, "weather."});
            break;
        case Stage::controls:
            for (world::Control& control : next.tick.controls)
                rows.push_back({world::ControlTypeTable(), bytes_of(control), control.actor(), ""});
            break;
        case Stage::traffic:
            for (world::CarState& car : next.traffic.cars)
                rows.push_back({world::CarStateTypeTable(), bytes_of(car), car.id(), ""});
            break;
        case Stage::pedestrians:
            for (world::WalkerState& walker : next.traffic.walkers)
                rows.push_back({world::WalkerStateTypeTable(), bytes_of(walker), walker.id(), ""});
            break;
        case Stage::physics:
            for (world::VehicleState& vehicle : next.tick.vehicles)
                rows.push_back(
                    {world::VehicleStateTypeTable(), bytes_of(vehicle), vehicle.id(), ""});
            for (world::WheelState& wheel : next.tick.wheels)
                rows.push_back({world::WheelStateTypeTable(),
                                bytes_of(wheel),
                                wheel.vehicle(),
                                wheel_prefix(wheel.index())});
            break;
        case Stage::measurements:
            for (world::Measurement& measured : next.tick.measurements)
                rows.push_back(
                    {world::MeasurementTypeTable(), bytes_of(measured), measured.actor(), ""});
            break;
    }
    return rows;
}

/// What the stage goes on from in the next tick. Weather and measurements are made anew or read
/// from the record; SUMO's own numbers stay.
void Nudger::move_behind_the_record(Stage stage, const Row& row) {
    if (stage == Stage::controls)
        roster_->replace_control(*static_cast<const world::Control*>(row.bytes));
    if (stage == Stage::pedestrians)
        pedestrians_->nudge(row.actor, nudge_->field, nudge_->units);
    if (stage == Stage::physics)
        physics_->nudge(row.actor, nudge_->field, nudge_->units);
}

void Nudger::after(Stage stage, world::TickDraft& next) {
    if (!is_due(next))
        return;
    if (stage == Stage::scenario && move_road_friction(next)) {
        nudge_.reset();
        return;
    }
    for (const Row& row : rows_of(stage, next)) {
        if (!move(row))
            continue;
        move_behind_the_record(stage, row);
        nudge_.reset();
        return;
    }
    if (stage == Stage::measurements)
        throw world::Error("--nudge " + nudge_->text + ": " + whereabouts(next));
}

/// Why there was nothing to move.
std::string Nudger::whereabouts(const world::TickDraft& next) const {
    std::vector<std::uint32_t> ids;
    for (const world::Control& control : next.tick.controls)
        ids.push_back(control.actor());
    for (const world::WalkerState& walker : next.traffic.walkers)
        ids.push_back(walker.id());
    for (const world::CarState& car : next.traffic.cars)
        ids.push_back(car.id());
    const std::string tick = std::to_string(next.tick.index);
    if (nudge_->actor.empty())
        return "in tick " + tick + " nobody has a '" + nudge_->field + "'";
    const auto wanted = wanted_actor();
    if (wanted && std::find(ids.begin(), ids.end(), *wanted) != ids.end())
        return "'" + nudge_->actor + "' has no '" + nudge_->field + "' in tick " + tick;
    std::vector<std::string> names;
    for (const auto& [id, name] : names_)
        if (std::find(ids.begin(), ids.end(), id) != ids.end())
            names.push_back(name);
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    const auto background = std::count_if(
        ids.begin(), ids.end(), [](auto id) { return id >= world::first_background_id; });
    return fmt::format("in tick {} there is no actor '{}'{}; there are {}{}{}",
                       tick,
                       nudge_->actor,
                       world::did_you_mean(nudge_->actor, names),
                       list.empty() ? "no actors of the scenario" : list,
                       background == 0 ? "" : fmt::format(", and {} background cars", background),
                       background == 0 ? "" : " by their ids");
}

}  // namespace reprise::kernel
