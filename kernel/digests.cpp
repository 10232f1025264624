#include "kernel/digests.h"

#include <span>

#include "world/digest.h"

namespace reprise::kernel {

namespace {

void add(world::Hasher& hasher, const world::SensorT& sensor) {
    hasher.add_text(sensor.name);
    hasher.add(sensor.kind);
    hasher.add(sensor.width);
    hasher.add(sensor.height);
    hasher.add(sensor.position);
    for (const double angle : {sensor.fov, sensor.yaw, sensor.pitch})
        hasher.add(angle);
    hasher.add(sensor.every);
}

/// Of words that most commands do without: each is told apart by its key, and costs nothing where
/// it is not said.
void add_rarer_words(world::Hasher& hasher, const world::CommandT& command) {
    const auto add_said = [&](char key, const auto& value, bool said) {
        if (!said)
            return;
        hasher.add(key);
        hasher.add(value);
    };
    add_said('s', command.shape, command.shape != world::Shape::sinusoidal);
    add_said('o', command.on, command.on);
    add_said('d', command.deceleration, command.deceleration != 0);
    add_said('h', command.heading, command.has_pose);
    add_said('p', std::span<const world::PathPoint>(command.path), !command.path.empty());
    add_said('i', std::span<const std::uint32_t>(command.signals), !command.signals.empty());
    add_said('c', command.color, command.color != world::SignalColor::off);
    add_said('l', command.lamps, command.lamps != 0);
    add_said('m', command.lamps_mask, command.lamps_mask != 0);
    add_said('r', command.doors, command.doors != 0);
    add_said('a', command.pilot, command.pilot != world::Pilot::idm);
}

}  // namespace

std::uint64_t digest_of(const scripting::Scenario& scenario, const world::TickDraft& next) {
    world::Hasher hasher;
    hasher.add(scenario.digest());
    hasher.add(next.tick.weather);
    hasher.add(next.tick.road_friction);
    for (const world::CommandT& command : next.tick.commands) {
        hasher.add(command.kind);
        hasher.add(command.actor);
        hasher.add(command.driver);
        hasher.add(command.model);
        hasher.add(command.lane);
        for (const double value : {command.s, command.offset, command.speed, command.duration})
            hasher.add(value);
        hasher.add(std::span<const std::uint32_t>(command.lanes));
        hasher.add(command.target);
        hasher.add(command.control);
        hasher.add(command.weather);
        hasher.add(command.road_friction);
        hasher.add_text(command.text);
        if (command.latency != 0)
            hasher.add(command.latency);
        for (const auto& sensor : command.rig)
            add(hasher, *sensor);
        if (command.sees_sensors)
            hasher.add(command.sees_sensors);
        add_rarer_words(hasher, command);
    }
    return hasher.digest64();
}

std::uint64_t digest_of(const Roster& roster,
                        const LampOrders& lamps,
                        const Doors& doors,
                        const world::TickDraft& next) {
    world::Hasher hasher;
    hasher.add(roster.digest());
    lamps.add_to(hasher);
    doors.add_to(hasher);
    hasher.add(std::span<const world::Control>(next.tick.controls));
    return hasher.digest64();
}

std::uint64_t digest_of(const traffic::Background& background, const world::TickDraft& next) {
    world::Hasher hasher;
    hasher.add(background.digest());
    hasher.add(std::span<const world::CarState>(next.traffic.cars));
    hasher.add(std::span<const world::Look>(next.traffic.looks));
    hasher.add(std::span<const world::SignalColor>(next.tick.signals));
    return hasher.digest64();
}

std::uint64_t digest_of(const Pedestrians& pedestrians, const world::TickDraft& next) {
    world::Hasher hasher;
    hasher.add(pedestrians.digest());
    hasher.add(std::span<const world::WalkerState>(next.traffic.walkers));
    return hasher.digest64();
}

std::uint64_t digest_of(const Physics& physics, const world::TickDraft& next) {
    world::Hasher hasher;
    hasher.add(physics.digest());
    hasher.add(std::span<const world::VehicleState>(next.tick.vehicles));
    hasher.add(std::span<const world::WheelState>(next.tick.wheels));
    hasher.add(std::span<const world::Look>(next.tick.looks));
    if (!next.tick.props.empty())
        hasher.add(std::span<const world::PropState>(next.tick.props));
    if (!next.tick.doors.empty())
        hasher.add(std::span<const world::Door>(next.tick.doors));
    return hasher.digest64();
}

std::uint64_t digest_of_measurements(const world::TickDraft& next) {
    world::Hasher hasher;
    hasher.add(std::span<const world::Measurement>(next.tick.measurements));
    for (const world::EventT& event : next.tick.events) {
        hasher.add(event.kind);
        hasher.add(event.actor);
        hasher.add(event.other);
        hasher.add(event.position);
        hasher.add(event.value);
        hasher.add_text(world::to_line(event));  // of a check also its detail
        if (event.duration != 0)
            hasher.add(event.duration);
    }
    return hasher.digest64();
}

}  // namespace reprise::kernel
