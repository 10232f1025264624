#include "tests/traffic/stage.h"

#include <algorithm>

#include "tests/support/worlds.h"
#include "world/models/catalogue.h"

namespace reprise::test {

Stage::Stage(const Loaded& loaded, std::uint32_t cars, std::uint64_t seed)
    : episode_(episode()),
      lanes_(loaded.town),
      last_(world::seal(draft_, {})) {
    episode_.town = loaded.town.name;
    episode_.cars = cars;
    episode_.seed = seed;
    background_ =
        std::make_unique<traffic::Background>(episode_, loaded.town, lanes_, loaded.network.xml);
}

const world::TickDraft& Stage::step(const std::vector<world::CommandT>& commands,
                                    const std::vector<world::VehicleState>& vehicles) {
    const std::uint64_t index = draft_.tick.index + 1;
    draft_ = {};
    draft_.tick.index = index;
    draft_.tick.commands = commands;
    background_->advance(last_.view(), draft_, traffic::Background::in_turn);
    for (world::CarState& car : draft_.traffic.cars)
        if (std::find(beacons.begin(), beacons.end(), car.id()) != beacons.end())
            car.mutate_lamps(static_cast<std::uint16_t>(car.lamps() | world::lamp_beacon));
    draft_.tick.vehicles = vehicles;
    draft_.tick.props = props;
    draft_.tick.doors = doors;
    draft_.traffic.walkers = walkers;
    last_ = world::seal(draft_, {});
    return draft_;
}

void Stage::steps(int count) {
    for (int i = 0; i < count; ++i)
        step();
}

const world::CarState* Stage::car(std::uint32_t id) const {
    return world::find(draft_.traffic.cars, id);
}

world::CommandT command(world::CommandKind kind, std::uint32_t actor) {
    world::CommandT command;
    command.kind = kind;
    command.actor = actor;
    command.line = 12;
    return command;
}

world::CommandT spawn(std::uint32_t actor,
                      std::uint32_t lane,
                      double s,
                      double speed,
                      world::Driver driver,
                      double offset) {
    world::CommandT spawn = command(world::CommandKind::spawn, actor);
    spawn.driver = driver;
    spawn.lane = lane;
    spawn.s = s;
    spawn.speed = speed;
    spawn.offset = offset;
    spawn.text = "car" + std::to_string(actor);
    return spawn;
}

world::VehicleState vehicle_on(const world::LaneT& lane, std::uint32_t id, double s, double speed) {
    const world::LanePoint at = world::point_at(lane, s);
    return vehicle_at(id, at.position.x(), at.position.y(), at.yaw, speed);
}

}  // namespace reprise::test
