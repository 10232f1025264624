#include "replay/table/derived.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "world/models/catalogue.h"

namespace reprise::replay {

namespace {

using world::CarState;
using world::Event;
using world::Measurement;
using world::VehicleState;
using world::WalkerState;

template <typename Struct>
const Struct& as(const void* element) {
    return *static_cast<const Struct*>(element);
}

// How each struct names its actor.
std::uint32_t actor_of(const VehicleState& state) {
    return state.id();
}

std::uint32_t actor_of(const CarState& state) {
    return state.id();
}

std::uint32_t actor_of(const WalkerState& state) {
    return state.id();
}

std::uint32_t actor_of(const world::PropState& state) {
    return state.id();
}

std::uint32_t actor_of(const world::WheelState& state) {
    return state.vehicle();
}

template <typename Other>
std::uint32_t actor_of(const Other& other) {
    return other.actor();
}

Value given_name(const TableNames& names, std::uint32_t id) {
    const std::string* name = names.actors->given(id);
    return name == nullptr ? Value() : Value(*name);
}

template <typename Struct>
Value name(const TableNames& names, const RecordedTick&, const void* element) {
    return given_name(names, actor_of(as<Struct>(element)));
}

Value other_name(const TableNames& names, const RecordedTick&, const void* element) {
    return given_name(names, as<Event>(element).other());
}

template <typename Struct>
Value lane_name(const TableNames& names, const RecordedTick&, const void* element) {
    const std::uint32_t lane = as<Struct>(element).lane();
    return lane < names.town->lanes.size() ? Value(names.town->lanes[lane].name) : Value();
}

const world::VehicleModel* model_of(std::uint16_t index) {
    const auto models = world::vehicle_models();
    return index < models.size() ? &models[index] : nullptr;
}

const world::VehicleModel* model_of(const RecordedTick&, const VehicleState& state) {
    return model_of(state.model());
}

const world::VehicleModel* model_of(const RecordedTick&, const CarState& state) {
    return model_of(state.model());
}

const world::VehicleModel* model_of(const RecordedTick& tick, const Measurement& measured) {
    const VehicleState* state = world::find(tick.view.vehicles(), measured.actor());
    return state == nullptr ? nullptr : model_of(state->model());
}

/// What `value` makes of the model; nothing where it is not known.
template <typename Struct, typename Get>
Value of_model(const RecordedTick& tick, const void* element, Get value) {
    const world::VehicleModel* model = model_of(tick, as<Struct>(element));
    return model == nullptr ? Value() : Value(value(*model));
}

template <typename Struct>
Value model_name(const TableNames&, const RecordedTick& tick, const void* element) {
    return of_model<Struct>(
        tick, element, [](const auto& model) { return std::string(model.name); });
}

Value walker_model(const TableNames&, const RecordedTick&, const void* element) {
    const std::uint16_t index = as<WalkerState>(element).model();
    const auto models = world::walker_models();
    return index < models.size() ? Value(std::string(models[index].name)) : Value();
}

template <typename Struct>
Value length(const TableNames&, const RecordedTick& tick, const void* element) {
    return of_model<Struct>(tick, element, [](const auto& model) { return model.length; });
}

template <typename Struct>
Value width(const TableNames&, const RecordedTick& tick, const void* element) {
    return of_model<Struct>(tick, element, [](const auto& model) { return model.width; });
}

/// From the rear axle to the front bumper. [m]
double front_of(const world::VehicleModel& model) {
    return model.length - model.rear_overhang;
}

Value front_s(const TableNames&, const RecordedTick& tick, const void* element) {
    return of_model<Measurement>(tick, element, [&](const auto& model) {
        return as<Measurement>(element).lane_s() + front_of(model);
    });
}

Value rear_axle_s(const TableNames&, const RecordedTick& tick, const void* element) {
    return of_model<CarState>(tick, element, [&](const auto& model) {
        return static_cast<double>(as<CarState>(element).lane_s()) - front_of(model);
    });
}

// Where a vehicle with mass is along its lane: what is measured of it in the same tick.
const Measurement* measured(const RecordedTick& tick, const void* vehicle) {
    return world::find(tick.view.measurements(), as<VehicleState>(vehicle).id());
}

Value lane_of_vehicle(const TableNames& names, const RecordedTick& tick, const void* element) {
    const Measurement* found = measured(tick, element);
    return found == nullptr ? Value() : lane_name<Measurement>(names, tick, found);
}

Value rear_axle_of_vehicle(const TableNames&, const RecordedTick& tick, const void* element) {
    const Measurement* found = measured(tick, element);
    return found == nullptr ? Value() : Value(found->lane_s());
}

Value front_of_vehicle(const TableNames& names, const RecordedTick& tick, const void* element) {
    const Measurement* found = measured(tick, element);
    return found == nullptr ? Value() : front_s(names, tick, found);
}

constexpr std::string_view rear_axle_column = "rear_axle_s";
constexpr std::string_view front_column = "front_s";

std::vector<Derived> all_columns(std::string_view table) {
    if (table == "vehicles")
        return {{"name", name<VehicleState>},
                {"model_name", model_name<VehicleState>},
                {"length", length<VehicleState>},
                {"width", width<VehicleState>},
                {"lane_name", lane_of_vehicle},
                {std::string(rear_axle_column), rear_axle_of_vehicle},
                {std::string(front_column), front_of_vehicle}};
    if (table == "measurements")
        return {{"name", name<Measurement>},
                {"model_name", model_name<Measurement>},
                {"length", length<Measurement>},
                {"width", width<Measurement>},
                {"lane_name", lane_name<Measurement>},
                {std::string(front_column), front_s}};
    if (table == "cars")
        return {{"name", name<CarState>},
                {"model_name", model_name<CarState>},
                {"length", length<CarState>},
                {"width", width<CarState>},
                {"lane_name", lane_name<CarState>},
                {std::string(rear_axle_column), rear_axle_s}};
    if (table == "walkers")
        return {{"name", name<WalkerState>}, {"model_name", walker_model}};
    if (table == "events")
        return {{"name", name<Event>}, {"other_name", other_name}};
    if (table == "commands")
        return {{"name", name<world::Command>}, {"lane_name", lane_name<world::Command>}};
    if (table == "controls")
        return {{"name", name<world::Control>}};
    if (table == "wheels")
        return {{"name", name<world::WheelState>}};
    if (table == "props")
        return {{"name", name<world::PropState>}};
    return {};
}

}  // namespace

std::vector<Derived> derived_columns(std::string_view table,
                                     const TableNames& names,
                                     bool whole_table) {
    std::vector<Derived> columns = all_columns(table);
    std::erase_if(columns, [&](const Derived& column) {
        const bool of_actors = column.name == "name" || column.name == "other_name";
        return (of_actors && names.actors == nullptr) ||
               (column.name == "lane_name" && names.town == nullptr) ||
               (!whole_table && column.name != "name");
    });
    return columns;
}

std::string column_of_field(std::string_view table, std::string column) {
    if (column != "lane_s")
        return column;
    return std::string(table == "cars" ? front_column : rear_axle_column);
}

std::string with_unit(const std::string& column) {
    // By the column's end: position_x, target_x; exact names have no underscore before them.
    constexpr auto exact = std::to_array<std::pair<std::string_view, std::string_view>>({
        {"time", "s"},
        {"duration", "s"},
        {"spawned", "s"},
        {"despawned", "s"},
        {"wrecked", "s"},
        {"speed", "m/s"},
        {"speed_limit", "m/s"},
        {"acceleration", "m/s2"},
        {"deceleration", "m/s2"},
        {"front_s", "m"},
        {"rear_axle_s", "m"},
        {"road_s", "m"},
        {"road_s_end", "m"},
        {"lane_t", "m"},
        {"s", "m"},
        {"offset", "m"},
        {"length", "m"},
        {"width", "m"},
        {"height", "m"},
        {"gap_ahead", "m"},
        {"goal_distance", "m"},
        {"odometer", "m"},
        {"engine_speed", "rad/s"},
        {"yaw", "rad"},
        {"pitch", "rad"},
        {"heading", "rad"},
        {"angle", "rad"},
        {"rotation", "rad"},
        {"steering_angle", "rad"},
        {"suspension_length", "m"},
        {"suspension_force", "N"},
        {"impulse_vehicles", "Ns"},
        {"impulse_walkers", "Ns"},
        {"impulse_static", "Ns"},
        {"weather_sun_azimuth", "rad"},
        {"weather_sun_altitude", "rad"},
        {"weather_rain", "mm/h"},
        {"weather_fog_extinction", "1/m"},
        {"weather_wind_speed", "m/s"},
        {"weather_wind_azimuth", "rad"},
    });
    constexpr auto begins = std::to_array<std::pair<std::string_view, std::string_view>>({
        {"position_", "m"},
        {"target_", "m"},
        {"velocity_", "m/s"},
        {"angular_velocity_", "rad/s"},
        {"acceleration_", "m/s2"},
    });
    for (const auto& [name, unit] : exact)
        if (column == name)
            return fmt::format("{} [{}]", column, unit);
    for (const auto& [prefix, unit] : begins)
        if (column.starts_with(prefix))
            return fmt::format("{} [{}]", column, unit);
    return column;
}

}  // namespace reprise::replay
