#include "exchange/page/page_actors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"

namespace reprise::exchange {

namespace {

using nlohmann::json;

constexpr double centi = 100;        // steps a metre, or a metre a second
constexpr double milli = 1000;       // steps a radian
constexpr std::int32_t turn = 4096;  // steps

std::int32_t steps(double value, double per_unit) {
    return static_cast<std::int32_t>(quantised(value, per_unit));
}

std::int16_t short_steps(double value, double per_unit) {
    return static_cast<std::int16_t>(
        std::clamp<std::int64_t>(quantised(value, per_unit), INT16_MIN, INT16_MAX));
}

std::int32_t lane_of(std::uint32_t lane) {
    return lane == world::none ? -1 : static_cast<std::int32_t>(lane & 0x0fff'ffff);
}

double yaw_of(const world::Quat& orientation) {
    const Eigen::Vector3d ahead =
        world::to_eigen(orientation).toRotationMatrix() * Eigen::Vector3d::UnitX();
    return std::atan2(ahead.y(), ahead.x());
}

json vehicle_shape(const world::VehicleModel& model) {
    return {{"name", model.name},
            {"length", model.length},
            {"width", model.width},
            {"rear", model.rear_overhang},
            {"wheelbase", model.wheelbase},
            {"track", model.track},
            {"body", static_cast<int>(model.body)},
            {"livery", static_cast<int>(model.livery)}};
}

/// Bits of the doors of an actor that stand open, shifted behind its lamps.
std::int32_t open_doors(const world::TickView& tick, std::uint32_t actor) {
    constexpr double ajar = 0.1;  // [rad]
    std::int32_t bits = 0;
    if (tick.tick->doors() != nullptr)
        for (const world::Door* door : *tick.tick->doors())
            if (door->actor() == actor && door->angle() > ajar && door->door() < 4)
                bits |= 1 << (16 + door->door());
    return bits;
}

json walker_shape(const world::WalkerModel& model) {
    return {{"name", model.name},
            {"length", model.girth / std::numbers::pi * 0.9},
            {"width", model.shoulder_width}};
}

/// By PropState.model.
json prop_shapes() {
    json shapes = json::array();
    for (const world::PropModel& model : world::prop_models())
        shapes.push_back({{"name", model.name},
                          {"length", model.length},
                          {"width", model.width},
                          {"form", static_cast<int>(model.form)},
                          {"paint", fmt::format("#{:06x}", model.paint & 0xff'ffff)}});
    return shapes;
}

}  // namespace

PageActors::Track& PageActors::track(Clock clock,
                                     Kind kind,
                                     std::uint32_t id,
                                     std::uint16_t model) {
    const std::size_t frame = ticks_[clock].size() - 1;
    const auto [found, is_new] = last_[clock].try_emplace(id, tracks_[clock].size());
    if (!is_new) {
        Track& last = tracks_[clock][found->second];
        if (last.first + last.samples.size() == frame && last.kind == kind && last.model == model)
            return last;
        found->second = tracks_[clock].size();
    }
    return tracks_[clock].emplace_back(Track{id, kind, model, frame, {}});
}

PageActors::Sample PageActors::sample(const world::Vec3& position, double yaw, double speed) {
    Sample made;
    made.x = steps(position.x(), centi);
    made.y = steps(position.y(), centi);
    made.yaw = steps(yaw / (2 * std::numbers::pi), turn);
    made.speed = steps(speed, centi);
    return made;
}

void PageActors::add_bodies(const world::TickView& tick) {
    ticks_[of_ticks].push_back(tick.index());
    for (const world::VehicleState& state : tick.vehicles()) {
        const world::Measurement* const measured = world::find(tick.measurements(), state.id());
        const world::Control* const control = world::find(tick.controls(), state.id());
        const double speed =
            measured != nullptr ? measured->speed() : world::to_eigen(state.velocity()).norm();
        Sample made = sample(state.position(), yaw_of(state.orientation()), speed);
        made.lamps = state.lamps() | open_doors(tick, state.id());
        made.steer = short_steps(state.steering_angle(), milli);
        if (measured != nullptr) {
            made.lane = lane_of(measured->lane());
            made.gap = steps(measured->gap_ahead(), centi);
            made.offset = steps(measured->lane_t(), centi);
        }
        if (control != nullptr)
            made.pedals =
                short_steps(control->brake() > 0 ? -control->brake() : control->throttle(), 100);
        track(of_ticks, Kind::vehicle, state.id(), state.model()).samples.push_back(made);
    }
    if (tick.tick->props() == nullptr)
        return;
    for (const world::PropState* state : *tick.tick->props()) {
        const double speed = world::to_eigen(state->velocity()).norm();
        track(of_ticks, Kind::prop, state->id(), state->model())
            .samples.push_back(sample(state->position(), yaw_of(state->orientation()), speed));
    }
}

void PageActors::add_traffic(const world::TickView& tick) {
    ticks_[of_traffic].push_back(tick.index());
    for (const world::CarState& state : tick.cars()) {
        Sample made = sample(state.position(), double{state.yaw()}, double{state.speed()});
        made.lamps = state.lamps() | open_doors(tick, state.id());
        made.lane = lane_of(state.lane());
        track(of_traffic, Kind::car, state.id(), state.model()).samples.push_back(made);
    }
    for (const world::WalkerState& state : tick.walkers()) {
        Sample made = sample(state.position(), double{state.yaw()}, double{state.speed()});
        made.lamps = state.down() ? 1 : 0;
        track(of_traffic, Kind::walker, state.id(), state.model()).samples.push_back(made);
    }
}

struct PageActors::Columns {
    NumberColumn clocks, x, y, yaw, speed, lane, lamps;
    NumberColumn steer, gap, offset, pedals;  ///< of vehicles with mass

    /// Their names and sizes go into `head`.
    std::string write(json& head) const {
        const std::pair<const char*, const NumberColumn*> all[]{{"clocks", &clocks},
                                                                {"x", &x},
                                                                {"y", &y},
                                                                {"yaw", &yaw},
                                                                {"speed", &speed},
                                                                {"lane", &lane},
                                                                {"lamps", &lamps},
                                                                {"steer", &steer},
                                                                {"gap", &gap},
                                                                {"offset", &offset},
                                                                {"pedals", &pedals}};
        std::string bytes;
        for (const auto& [name, column] : all) {
            head["columns"].push_back({name, column->bytes().size()});
            bytes += column->bytes();
        }
        return bytes;
    }
};

/// Differences to the frame before; of places, to where the same step again would have led: who
/// drives on as before is a row of zeros.
void PageActors::append(const Track& track, Columns& columns) {
    Sample before;
    std::int32_t step_x = 0, step_y = 0;
    bool is_first = true;
    for (const Sample& now : track.samples) {
        columns.x.append(std::int64_t{now.x} - before.x - step_x);
        columns.y.append(std::int64_t{now.y} - before.y - step_y);
        step_x = is_first ? 0 : now.x - before.x;
        step_y = is_first ? 0 : now.y - before.y;
        const std::int32_t turned = now.yaw - before.yaw;
        columns.yaw.append((turned % turn + turn + turn / 2) % turn - turn / 2);
        columns.speed.append(std::int64_t{now.speed} - before.speed);
        columns.lane.append(std::int64_t{now.lane} - before.lane);
        columns.lamps.append(std::int64_t{now.lamps} - before.lamps);
        if (track.kind == Kind::vehicle) {
            columns.steer.append(now.steer - before.steer);
            columns.gap.append(std::int64_t{now.gap} - before.gap);
            columns.offset.append(std::int64_t{now.offset} - before.offset);
            columns.pedals.append(now.pedals - before.pedals);
        }
        before = now;
        is_first = false;
    }
}

std::string PageActors::write(json& head) const {
    Columns columns;
    head["clocks"] = json::array();
    head["tracks"] = json::array();
    for (std::size_t clock = 0; clock < clocks; ++clock) {
        head["clocks"].push_back(ticks_[clock].size());
        std::uint64_t last = 0;
        for (const std::uint64_t tick : ticks_[clock]) {
            columns.clocks.append(static_cast<std::int64_t>(tick - last));
            last = tick;
        }
        for (const Track& track : tracks_[clock]) {
            head["tracks"].push_back(
                {track.id, track.kind, track.model, clock, track.first, track.samples.size()});
            append(track, columns);
        }
    }
    head["models"] = json::array();
    for (const world::VehicleModel& model : world::vehicle_models())
        head["models"].push_back(vehicle_shape(model));
    head["walkers"] = json::array();
    for (const world::WalkerModel& model : world::walker_models())
        head["walkers"].push_back(walker_shape(model));
    head["props"] = prop_shapes();
    return columns.write(head);
}

}  // namespace reprise::exchange
