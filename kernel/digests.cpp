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
    }
    return hasher.digest64();
}

std::uint64_t digest_of(const Roster& roster, const world::TickDraft& next) {
    world::Hasher hasher;
    hasher.add(roster.digest());
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
    }
    return hasher.digest64();
}

}  // namespace reprise::kernel
