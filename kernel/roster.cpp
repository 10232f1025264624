#include "kernel/roster.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "drivers/control/pedals.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/frames.h"
#include "world/models/car_model.h"
#include "world/models/catalogue.h"
#include "world/random.h"
#include "world/trajectory.h"

namespace reprise::kernel {

namespace {

bool has_mass(world::Driver driver) {
    return driver == world::Driver::autopilot || world::takes_controls(driver);
}

/// Stands still until its driver says something: nobody at the wheel, foot on the brake.
world::Control parked_control(std::uint32_t actor) {
    return {0, 1, 0, actor, 0, false, false};
}

/// Sine of the angle uphill.
double climb_of(const Eigen::Isometry3d& pose_world_vehicle) {
    return pose_world_vehicle.linear()(2, 0);
}

/// Without a target: is it to keep its lane from now on, or free to change? Within a time: at once.
void change_lane(drivers::Autopilot& autopilot, const world::CommandT& command) {
    if (!world::names_lane(command))
        autopilot.keep_lane(!command.lanes.empty());
    else if (command.duration > 0 || command.shape == world::Shape::step)
        autopilot.switch_lane(command.lanes.front(), command.duration, command.shape);
    else
        autopilot.change_lane(command.lanes.front());
}

/// Of those about how it drives.
void give_order(drivers::Autopilot& autopilot, const world::CommandT& command) {
    switch (command.kind) {
        case world::CommandKind::set_speed:
            autopilot.set_speed(command.speed, command.duration, command.shape);
            break;
        case world::CommandKind::free_speed:
            autopilot.free_speed();
            break;
        case world::CommandKind::hold_speed:
            if (command.on)
                autopilot.hold_speed(command.speed, command.duration, command.shape);
            else
                autopilot.end_hold();
            break;
        case world::CommandKind::brake:
            if (command.on)
                autopilot.brake(command.deceleration);
            else
                autopilot.end_brake();
            break;
        case world::CommandKind::set_offset:
            autopilot.set_offset(command.offset, command.duration, command.shape);
            break;
        case world::CommandKind::ignore_lights:
            autopilot.ignore_lights(command.on);
            break;
        case world::CommandKind::may_overtake:
            autopilot.may_overtake(command.on);
            break;
        case world::CommandKind::set_route:
            autopilot.set_route(command.lanes, command.s);
            break;
        case world::CommandKind::change_lane:
            change_lane(autopilot, command);
            break;
        default:
            break;
    }
}

world::EventT event(world::EventKind kind, std::uint32_t actor, const world::CommandT& command) {
    world::EventT event;
    event.kind = kind;
    event.actor = actor;
    event.text = command.text;
    event.line = command.line;
    return event;
}

}  // namespace

Roster::Roster(const world::EpisodeT& episode,
               const world::TownT& town,
               const world::LaneMap& lanes,
               std::span<const world::Obstacle> obstacles)
    : episode_(&episode),
      town_(&town),
      map_(town, lanes, obstacles) {}

void Roster::apply_commands(const world::TickView& last, world::TickDraft& next, Physics& physics) {
    for (world::CommandT& command : next.tick.commands) {
        if (command.kind == world::CommandKind::spawn) {
            if (has_mass(command.driver))
                spawn(last, command, next, physics);
            else
                names_[command.actor] = command.text;
            continue;
        }
        const auto found = entries_.find(command.actor);
        if (found == entries_.end())
            continue;
        Entry& entry = found->second;
        if (entry.wrecked_at != 0 && command.kind != world::CommandKind::despawn) {
            refuse(command, entry, next);
            continue;
        }
        if (entry.autopilot)
            give_order(*entry.autopilot, command);
        switch (command.kind) {
            case world::CommandKind::despawn:
                despawn(command, next, physics);
                break;
            case world::CommandKind::set_route:
            case world::CommandKind::change_lane:
                entry.route_line = command.line;
                break;
            case world::CommandKind::follow:
            case world::CommandKind::teleport:
            case world::CommandKind::set_velocity:
                carry_out(command, entry, next.tick.index, physics);
                break;
            case world::CommandKind::control:
                entry.control = command.control;
                entry.scripted = true;
                break;
            default:
                break;
        }
    }
}

void Roster::despawn(const world::CommandT& command, world::TickDraft& next, Physics& physics) {
    world::EventT despawned = event(world::EventKind::despawned, command.actor, command);
    despawned.position = physics.remove_vehicle(command.actor);
    next.tick.events.push_back(despawned);
    entries_.erase(command.actor);
}

void Roster::take_over(std::span<const Wreck> wrecks, world::TickDraft& next) {
    for (const Wreck& wreck : wrecks) {
        const world::VehicleState& vehicle = *world::find(next.tick.vehicles, wreck.id);
        Entry entry{vehicle.model(), std::nullopt, wreck_control(wreck.id, wreck.speed)};
        entry.scripted = true;
        entry.wrecked_at = next.tick.index;
        const auto at = std::lower_bound(
            next.tick.controls.begin(),
            next.tick.controls.end(),
            wreck.id,
            [](const world::Control& control, std::uint32_t id) { return control.actor() < id; });
        next.tick.controls.insert(at, entry.control);
        entries_.insert_or_assign(wreck.id, std::move(entry));
    }
}

void Roster::end_trajectories(std::span<const std::uint32_t> derailed) {
    for (const std::uint32_t id : derailed)
        entries_.at(id).follows_until = 0;
}

/// Nobody drives a wreck.
void Roster::refuse(const world::CommandT& command, Entry& entry, world::TickDraft& next) const {
    const std::uint32_t bit = 1U << static_cast<std::uint32_t>(command.kind);
    if (command.kind == world::CommandKind::set_lamps ||
        command.kind == world::CommandKind::set_doors || (entry.told & bit) != 0)
        return;
    entry.told |= bit;
    world::EventT refused = event(world::EventKind::printed, command.actor, command);
    refused.text = fmt::format("{}: {} is a wreck since {:.2f} s: nobody drives it",
                               world::EnumNameCommandKind(command.kind),
                               names_.at(command.actor),
                               world::seconds(entry.wrecked_at, episode_->step_ns));
    next.tick.events.push_back(std::move(refused));
}

void Roster::spawn(const world::TickView& last,
                   world::CommandT& command,
                   world::TickDraft& next,
                   Physics& physics) {
    if (command.lane == world::none && !command.has_pose)
        choose_place(last, next.tick.commands, command);
    const Eigen::Isometry3d pose_world_vehicle = pose_of(command, command.model, physics);
    physics.add_vehicle(command.actor, command.model, pose_world_vehicle, command.speed);

    Entry entry{command.model, std::nullopt, parked_control(command.actor)};
    if (command.driver == world::Driver::autopilot) {
        entry.autopilot.emplace(command.actor, command.model, *episode_, map_, command.pilot);
        entry.route_line = command.line;
        if (!command.lanes.empty())
            entry.autopilot->set_route(command.lanes, town_->lanes.at(command.lanes.back()).length);
    }
    if (command.speed > 0)
        roll(entry, command, climb_of(pose_world_vehicle), next.tick.index);
    entries_.insert_or_assign(command.actor, std::move(entry));
    world::EventT spawned = event(world::EventKind::spawned, command.actor, command);
    spawned.position = world::to_vec3(pose_world_vehicle.translation());
    next.tick.events.push_back(spawned);
}

/// On a lane, or anywhere.
Eigen::Isometry3d Roster::pose_of(const world::CommandT& command,
                                  std::uint16_t model,
                                  const Physics& physics) const {
    if (command.has_pose)
        return physics.stance(model, world::to_eigen(command.target), command.heading);
    const world::LanePoint place = world::point_at(town_->lanes.at(command.lane), command.s);
    return world::pose(world::to_vec3(place.position), place.yaw, place.pitch) *
           Eigen::Translation3d(0, command.offset, 0);
}

/// Commands that decide where a vehicle is, whoever drives it.
void Roster::carry_out(const world::CommandT& command,
                       Entry& entry,
                       std::uint64_t tick,
                       Physics& physics) const {
    if (command.kind == world::CommandKind::follow)
        follow(command, entry, tick, physics);
    else
        move(command, entry, tick, physics);
}

void Roster::follow(const world::CommandT& command,
                    Entry& entry,
                    std::uint64_t tick,
                    Physics& physics) const {
    if (entry.autopilot)
        entry.autopilot->put_elsewhere();
    if (command.path.empty()) {
        entry.follows_until = 0;
        return physics.let_go(command.actor);
    }
    // The scenario counts from what it saw: the tick before this one.
    const std::uint64_t start = tick - 1;
    const double step = world::seconds(1, episode_->step_ns);
    entry.follows_until = start + world::last_tick_of(command.path, step);
    physics.follow(command.actor, world::Trajectory(command.path, command.has_pose), start);
}

/// Elsewhere, or at another speed. Its driver has not seen that yet: an autopilot holds the speed
/// for this tick.
void Roster::move(const world::CommandT& command,
                  Entry& entry,
                  std::uint64_t tick,
                  Physics& physics) const {
    double climb = 0;
    if (command.kind == world::CommandKind::teleport) {
        const Eigen::Isometry3d pose_world_vehicle = pose_of(command, entry.model, physics);
        physics.teleport(command.actor, pose_world_vehicle, command.speed);
        climb = climb_of(pose_world_vehicle);
        entry.follows_until = 0;
    } else {
        physics.set_speed(command.actor, command.speed);
    }
    if (!entry.autopilot)
        return;
    if (command.kind == world::CommandKind::teleport)
        entry.autopilot->put_elsewhere();
    else
        entry.autopilot->put_to_speed();
    entry.moved_at = tick;
    entry.control = command.speed > 0 ? drivers::rolling_control(
                                            command.actor,
                                            world::car_model(world::vehicle_models()[entry.model]),
                                            command.speed,
                                            climb,
                                            world::seconds(1, episode_->step_ns))
                                      : parked_control(command.actor);
}

/// Until its driver has seen the tick of its spawn, and could answer, it goes on as fast as it is.
void Roster::roll(Entry& entry,
                  const world::CommandT& spawn,
                  double climb,
                  std::uint64_t tick) const {
    entry.control = drivers::rolling_control(spawn.actor,
                                             world::car_model(world::vehicle_models()[spawn.model]),
                                             spawn.speed,
                                             climb,
                                             static_cast<double>(episode_->step_ns) * 1e-9);
    entry.rolls_until = tick + spawn.latency;
}

void Roster::choose_place(const world::TickView& last,
                          std::span<const world::CommandT> said,
                          world::CommandT& command) const {
    constexpr double shortest_lane = 30;  // [m] room to roll before the first junction
    constexpr std::uint64_t tries = 256;
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t lane = 0; lane < town_->lanes.size(); ++lane)
        if (town_->lanes[lane].kind == world::LaneKind::driving &&
            town_->lanes[lane].length >= shortest_lane && !town_->lanes[lane].links.empty())
            candidates.push_back(lane);
    // Not on the way out of the map, where there is another one.
    const auto goes_on = [&](std::uint32_t lane) { return map_.graph.goes_on(lane); };
    if (std::any_of(candidates.begin(), candidates.end(), goes_on))
        std::erase_if(candidates, std::not_fn(goes_on));
    if (candidates.empty())
        throw world::Error(episode_->scenario_path + ":" + std::to_string(command.line) +
                           ": spawn: " + town_->name +
                           " has no lane of at least 30 m to start on; " +
                           "name one with lane = '...'");
    const std::uint64_t item = std::uint64_t{command.actor} * tries * 2;
    for (std::uint64_t attempt = 0; attempt < tries; ++attempt) {
        command.lane = candidates[world::draw_index(candidates.size(),
                                                    episode_->seed,
                                                    last.index(),
                                                    world::Purpose::place,
                                                    item + 2 * attempt)];
        const world::LaneT& lane = town_->lanes[command.lane];
        const double share = world::draw(
            episode_->seed, last.index(), world::Purpose::place, item + 2 * attempt + 1);
        command.s = 5 + share * (lane.length - shortest_lane + 10);
        if (is_free(last, said, command, world::point_at(lane, command.s).position))
            return;
    }
    throw world::Error(episode_->scenario_path + ":" + std::to_string(command.line) +
                       ": spawn: found no free place for '" + command.text + "' in " + town_->name +
                       "; name one with lane = '...', or take fewer cars");
}

/// Is nobody near: in the last tick, or among those who are spawned in this one?
bool Roster::is_free(const world::TickView& last,
                     std::span<const world::CommandT> said,
                     const world::CommandT& self,
                     const Eigen::Vector3d& p_world) const {
    constexpr double room = 15;  // [m] between rear axles
    const auto near = [&](const auto& actor) {
        return (world::to_eigen(actor.position()) - p_world).norm() < room;
    };
    const auto spawned_near = [&](const world::CommandT& other) {
        return other.kind == world::CommandKind::spawn && other.actor != self.actor &&
               other.lane != world::none &&
               (world::point_at(town_->lanes.at(other.lane), other.s).position - p_world).norm() <
                   room;
    };
    return std::none_of(last.cars().begin(), last.cars().end(), near) &&
           std::none_of(last.vehicles().begin(), last.vehicles().end(), near) &&
           std::none_of(said.begin(), said.end(), spawned_near);
}

/// Neither where a trajectory drives nor where nothing of it can be seen yet.
bool Roster::decides(const Entry& entry,
                     std::uint32_t id,
                     const world::TickView& last,
                     std::uint64_t tick) {
    return entry.autopilot && (entry.follows_until == 0 || tick > entry.follows_until) &&
           entry.moved_at != tick && find(last.vehicles(), id) != nullptr;
}

/// The autopilot plans a new route when it next decides; what it then finds impossible is the
/// mistake of the line that asked for the route.
void Roster::decide(const world::TickView& last, std::uint64_t tick) {
    for (auto& [id, entry] : entries_) {
        if (!decides(entry, id, last, tick))
            continue;
        try {
            entry.control = entry.autopilot->decide(last);
        } catch (const world::Error& error) {
            entry.mistake = std::make_exception_ptr(world::Error(episode_->scenario_path + ":" +
                                                                 std::to_string(entry.route_line) +
                                                                 ": " + error.what()));
        }
    }
}

/// What the autopilot does of its own will is an event.
void Roster::tell_news(const Entry& entry,
                       const world::TickView& last,
                       world::TickDraft& next) const {
    const drivers::DriverNews* news = entry.autopilot->news();
    if (news == nullptr)
        return;
    world::EventT event;
    event.kind = news->kind;
    event.actor = entry.control.actor();
    event.other = news->other;
    event.position = world::find(last.vehicles(), entry.control.actor())->position();
    event.text = news->text;
    next.tick.events.push_back(std::move(event));
}

void Roster::apply_controls(std::span<const world::Control> controls,
                            const world::TickView& last,
                            world::TickDraft& next) {
    for (const world::Control& control : controls) {
        const auto found = entries_.find(control.actor());
        if (found == entries_.end() || found->second.autopilot || found->second.scripted)
            continue;
        found->second.control = control;
        found->second.rolls_until = 0;
    }
    for (auto& [id, entry] : entries_) {
        if (entry.mistake)
            std::rethrow_exception(entry.mistake);
        const bool in_last_tick = find(last.vehicles(), id) != nullptr;
        if (next.tick.index > entry.follows_until)
            entry.follows_until = 0;
        if (entry.autopilot && entry.follows_until > 0)
            entry.control = {0, 0, 0, id, 0, false, false};  // a trajectory drives
        else if (decides(entry, id, last, next.tick.index))
            tell_news(entry, last, next);
        else if (!entry.autopilot && !entry.scripted && entry.rolls_until > 0 &&
                 next.tick.index > entry.rolls_until)
            entry.control = parked_control(id);  // nobody took the wheel
        if (entry.wrecked_at != 0 && in_last_tick)
            entry.control =
                wreck_control(id, world::to_eigen(find(last.vehicles(), id)->velocity()).norm());
        entry.control.mutate_actor(id);
        next.tick.controls.push_back(entry.control);
    }
}

bool Roster::is_under_way(const world::VehicleState& vehicle) const {
    constexpr double driven = 1;  // [m] what settles on its springs has not driven
    const Entry& entry = entries_.at(vehicle.id());
    if (entry.follows_until > 0)
        return false;
    if (entry.autopilot)
        return entry.autopilot->is_under_way();
    if (entry.control.hand_brake())
        return false;
    return entry.control.throttle() > 0 || (!entry.scripted && vehicle.odometer() > driven);
}

void Roster::replace_control(const world::Control& control) {
    entries_.at(control.actor()).control = control;
}

std::uint64_t Roster::digest() const {
    world::Hasher hasher;
    hasher.add(std::uint64_t{entries_.size()});
    for (const auto& [id, entry] : entries_) {
        hasher.add(id);
        hasher.add(entry.control);
        hasher.add(entry.autopilot.has_value());
        if (entry.scripted)
            hasher.add(true);
        if (entry.follows_until > 0)
            hasher.add(entry.follows_until);
        if (entry.autopilot)
            hasher.add(entry.autopilot->digest());
        if (entry.wrecked_at != 0) {
            hasher.add(entry.wrecked_at);
            hasher.add(entry.told);
        }
    }
    return hasher.digest64();
}

}  // namespace reprise::kernel
