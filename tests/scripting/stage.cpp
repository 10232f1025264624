#include "tests/scripting/stage.h"

#include <algorithm>
#include <cmath>

#include "world/check.h"
#include "world/frames.h"
#include "world/town.h"

namespace reprise::test {

namespace {

world::EpisodeT episode_of(const std::string& source) {
    return episode(source.c_str());
}

}  // namespace

std::string running(const std::string& body) {
    return "return scenario 'test' { run = function(p) " + body + "\nend }";
}

Stage::Stage(const std::string& source, world::TownT its_town)
    : episode(episode_of(source)),
      town(std::move(its_town)),
      lanes(town),
      scenario(episode, town, lanes),
      last_([] {
          world::TickDraft genesis;
          return world::seal(genesis, {});
      }()) {}

const world::TickDraft& Stage::step() {
    world::TickDraft next;
    next.tick.index = last_.view().index() + 1;
    next.tick.road_friction = 1;
    scenario.advance(last_.view(), next);
    for (const world::CommandT& command : next.tick.commands)
        obey(command);
    commands.insert(commands.end(), next.tick.commands.begin(), next.tick.commands.end());
    events.insert(events.end(), next.tick.events.begin(), next.tick.events.end());
    digests.push_back(scenario.digest());
    for (Body& body : bodies_)
        body.s += body.speed * 0.05;
    place(next);
    if (!measurements_.empty())
        next.tick.measurements = measurements_;
    next.tick.events.insert(next.tick.events.end(), collisions_.begin(), collisions_.end());
    collisions_.clear();
    draft_ = next;
    last_ = world::seal(next, {});
    return draft_;
}

std::vector<std::string> Stage::play(int ticks) {
    for (int i = 0; i < ticks && !finished(); ++i)
        step();
    std::vector<std::string> lines;
    for (const world::EventT& event : events)
        if (event.kind == world::EventKind::printed)
            lines.push_back(event.text);
    return lines;
}

void Stage::conclude() {
    const std::size_t before = draft_.tick.events.size();
    scenario.conclude(last_.view(), draft_);
    const auto& all = draft_.tick.events;
    events.insert(events.end(), all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
}

void Stage::collide(std::uint32_t actor, std::uint32_t other) {
    world::EventT event;
    event.kind = world::EventKind::collision;
    event.actor = actor;
    event.other = other;
    collisions_.push_back(event);
}

void Stage::remove(std::uint32_t actor) {
    std::erase_if(bodies_, [&](const Body& body) { return body.id == actor; });
}

void Stage::halt(std::uint32_t actor, std::uint64_t ticks) {
    world::Measurement measured;
    measured.mutate_actor(actor);
    measured.mutate_halted_ticks(ticks);
    measurements_ = {measured};
}

bool Stage::finished() const {
    return !commands.empty() && commands.back().kind == world::CommandKind::finish;
}

std::string Stage::reason() const {
    return finished() ? commands.back().text : "";
}

void Stage::obey(const world::CommandT& command) {
    if (command.kind == world::CommandKind::despawn)
        remove(command.actor);
    if (command.kind == world::CommandKind::set_speed)
        for (Body& body : bodies_)
            if (body.id == command.actor)
                body.speed = command.speed;
    if (command.kind != world::CommandKind::spawn)
        return;
    const std::uint32_t lane = command.lane == world::none ? 1 : command.lane;
    bodies_.push_back({command.actor,
                       command.driver,
                       command.model,
                       lane,
                       command.s,
                       command.offset,
                       command.speed});
}

/// The last vehicle, as the kernel would.
void Stage::measure(const Body& body, world::TickDraft& draft) const {
    draft.tick.vehicles.back().mutate_model(body.model);
    world::Measurement measured;
    measured.mutate_actor(body.id);
    measured.mutate_speed(body.speed);
    measured.mutate_lane(body.lane);
    measured.mutate_lane_s(body.s);
    measured.mutate_lane_t(body.offset);
    draft.tick.measurements.push_back(measured);
}

void Stage::place(world::TickDraft& draft) const {
    for (const Body& body : bodies_) {
        const world::LanePoint at = world::point_at(town.lanes[body.lane], body.s);
        const double x = at.position.x() - body.offset * std::sin(at.yaw);
        const double y = at.position.y() + body.offset * std::cos(at.yaw);
        const auto yaw = static_cast<float>(at.yaw);
        const auto speed = static_cast<float>(body.speed);
        const world::Vec3 position(x, y, 0);
        if (body.driver == world::Driver::walker)
            draft.traffic.walkers.emplace_back(
                position, yaw, speed, 0.0F, body.id, body.model, false, std::uint8_t{0}, 0U);
        else if (body.driver == world::Driver::traffic || body.driver == world::Driver::parked)
            draft.traffic.cars.push_back(car_at(body.id, x, y, at.yaw, body.speed));
        else
            draft.tick.vehicles.push_back(vehicle_at(body.id, x, y, at.yaw, body.speed));
        if (body.driver == world::Driver::traffic || body.driver == world::Driver::parked)
            draft.traffic.cars.back().mutate_model(body.model);
        else if (body.driver != world::Driver::walker)
            measure(body, draft);
    }
}

std::string mistake(const std::string& body) {
    return mistake_in_file(running(body));
}

std::string mistake_in_file(const std::string& source) {
    try {
        Stage stage(source);
        stage.play(150);
    } catch (const world::Error& error) {
        return error.what();
    }
    return "";
}

std::vector<std::string> printed(const std::string& body) {
    Stage stage(running(body));
    return stage.play(40);
}

}  // namespace reprise::test
