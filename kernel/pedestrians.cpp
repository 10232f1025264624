#include "kernel/pedestrians.h"

#include <algorithm>
#include <cmath>

#include "ground/mesh/ground.h"
#include "kernel/drill/nudge.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

using world::rounded;

constexpr double walking_acceleration = 2;  // [m/s^2]
constexpr std::uint32_t many = 12;          // of 1.5 us a tick each, where a second thread costs 10

bool is_raised(const world::LaneT& lane) {
    return lane.kind == world::LaneKind::sidewalk || lane.kind == world::LaneKind::walking_area;
}

}  // namespace

Pedestrians::Pedestrians(const world::EpisodeT& episode,
                         const world::TownT& town,
                         const world::LaneMap& lanes,
                         const ground::GroundMesh& ground)
    : town_(&town),
      lanes_(&lanes),
      ground_(&ground),
      seed_(episode.seed),
      step_(static_cast<double>(episode.step_ns) * 1e-9),
      are_many_(episode.walkers >= many) {
    if (episode.walkers > 0)
        crowd_ = std::make_unique<walkers::Crowd>(episode, town, lanes, walking_ground());
}

walkers::WalkingGround& Pedestrians::walking_ground() {
    if (!walking_ground_)
        walking_ground_ = std::make_unique<walkers::WalkingGround>(*town_, ground_);
    return *walking_ground_;
}

Pedestrians::Walker* Pedestrians::find(std::uint32_t id) {
    const auto at = std::lower_bound(
        walkers_.begin(), walkers_.end(), id, [](const Walker& w, std::uint32_t wanted) {
            return w.id < wanted;
        });
    return at != walkers_.end() && at->id == id ? &*at : nullptr;
}

walkers::OnFoot Pedestrians::advance(const world::TickView& last,
                                     std::span<const world::CommandT> commands) {
    walkers::OnFoot next{last.index() + 1, {}, {}};
    for (const world::CommandT& command : commands)
        obey(command, next);
    lay_down(last);
    for (Walker& walker : walkers_) {
        if (walker.trajectory)
            follow(walker, next.tick);
        else
            walk(walker);
        const world::Vec3 position(rounded(walker.position.x(), 1024),
                                   rounded(walker.position.y(), 1024),
                                   rounded(walker.position.z(), 1024));
        const double phase = std::floor(walker.phase * 8192) / 8192;  // stays below 1
        next.walkers.emplace_back(position,
                                  static_cast<float>(rounded(walker.yaw, 8192)),
                                  static_cast<float>(rounded(walker.speed, 1024)),
                                  static_cast<float>(phase),
                                  walker.id,
                                  walker.model,
                                  walker.down,
                                  std::uint8_t{0},
                                  world::drawn_look(seed_, walker.id).look());
    }
    if (crowd_)
        crowd_->advance(last, next);
    return next;
}

void Pedestrians::obey(const world::CommandT& command, walkers::OnFoot& next) {
    using world::CommandKind;
    if (command.kind == CommandKind::spawn) {
        if (command.driver == world::Driver::walker)
            spawn(command, next);
        return;
    }
    Walker* walker = find(command.actor);
    if (walker == nullptr)
        return;
    const double own_speed = world::walker_models()[walker->model].walking_speed;
    switch (command.kind) {
        case CommandKind::walk:
            walker->target = world::to_eigen(command.target);
            walker->wanted_speed = command.speed > 0 ? command.speed : own_speed;
            walker->walking = true;
            take_way(command, *walker, next);
            break;
        case CommandKind::set_speed:
            walker->wanted_speed = std::max(command.speed, 0.0);
            break;
        case CommandKind::free_speed:
            walker->wanted_speed = own_speed;
            break;
        case CommandKind::follow:
            walker->trajectory.reset();
            walker->walking = false;
            walker->speed = 0;
            if (!command.path.empty() && !walker->down)
                walker->trajectory.emplace(command.path, command.has_pose);
            walker->trajectory_start = next.tick - 1;  // what the scenario saw
            break;
        case CommandKind::teleport:
            teleport(command, *walker);
            break;
        case CommandKind::set_velocity:
            walker->speed = command.speed;
            break;
        case CommandKind::despawn:
            despawn(command, next);
            break;
        default:
            break;
    }
}

void Pedestrians::spawn(const world::CommandT& command, walkers::OnFoot& next) {
    REPRISE_CHECK(command.model < world::walker_models().size(), std::to_string(command.model));
    REPRISE_CHECK(find(command.actor) == nullptr, "walker " + std::to_string(command.actor));
    Walker walker;
    walker.id = command.actor;
    walker.model = command.model;
    walker.wanted_speed = world::walker_models()[walker.model].walking_speed;
    place(command, walker);
    const auto at = std::upper_bound(
        walkers_.begin(), walkers_.end(), walker.id, [](std::uint32_t id, const Walker& w) {
            return id < w.id;
        });
    walkers_.insert(at, walker);

    world::EventT event;
    event.kind = world::EventKind::spawned;
    event.actor = walker.id;
    event.position = world::to_vec3(walker.position);
    event.text = command.text;
    event.line = command.line;
    next.events.push_back(event);
}

/// Where the command says so, by the walk map: corner by corner. Where no way leads there,
/// straight.
void Pedestrians::take_way(const world::CommandT& command, Walker& walker, walkers::OnFoot& next) {
    walker.way.clear();
    if (!command.on)
        return;
    const auto way = walking_ground().streets().path(walker.position, walker.target);
    if (!way || way->size() < 2) {
        world::EventT event;
        event.kind = world::EventKind::printed;
        event.text = "walker " + std::to_string(walker.id) +
                     ": walk_to: no way leads there on foot: goes straight";
        event.line = command.line;
        next.events.push_back(std::move(event));
        return;
    }
    for (std::size_t i = way->size(); i-- > 1;)  // the next one last
        walker.way.push_back((*way)[i].position);
    walker.way.front() = walker.target;
    walker.target = walker.way.back();
    walker.way.pop_back();
}

/// At a lane, s and offset, or at a pose.
void Pedestrians::place(const world::CommandT& command, Walker& walker) const {
    if (command.lane < town_->lanes.size() && !command.has_pose) {
        const world::LanePoint at = world::point_at(town_->lanes[command.lane], command.s);
        const Eigen::Vector3d left(-std::sin(at.yaw), std::cos(at.yaw), 0);
        walker.position = at.position + command.offset * left;
        walker.yaw = at.yaw;
    } else {
        walker.position = world::to_eigen(command.target);
        walker.yaw = command.has_pose ? command.heading : walker.yaw;
    }
    walker.position.z() = ground_height(walker.position);
}

/// Goes on from there to where it was told.
void Pedestrians::teleport(const world::CommandT& command, Walker& walker) const {
    walker.trajectory.reset();
    place(command, walker);
    walker.speed = command.speed;
}

void Pedestrians::despawn(const world::CommandT& command, walkers::OnFoot& next) {
    Walker* walker = find(command.actor);
    world::EventT event;
    event.kind = world::EventKind::despawned;
    event.actor = walker->id;
    event.position = world::to_vec3(walker->position);
    event.line = command.line;
    next.events.push_back(event);
    walkers_.erase(walkers_.begin() + (walker - walkers_.data()));
}

void Pedestrians::lay_down(const world::TickView& last) {
    const auto* events = last.tick->events();
    if (events == nullptr)
        return;
    for (const world::Event* event : *events) {
        if (event->kind() != world::EventKind::collision)
            continue;
        Walker* walker = find(event->other());
        if (walker != nullptr)
            walker->down = true;
    }
}

/// The height of the ground and the walk cycle, after so many metres.
void Pedestrians::step_on(Walker& walker, double distance, double speed) const {
    walker.position.z() = ground_height(walker.position);
    const double height = world::walker_models()[walker.model].height;
    walker.phase += distance / walk_cycle_length(speed, height);
    walker.phase -= std::floor(walker.phase);
}

/// Where the trajectory says. Behind its end it stands.
void Pedestrians::follow(Walker& walker, std::uint64_t tick) const {
    constexpr double rounding = 1e-9;  // [s]
    const double time = static_cast<double>(tick - walker.trajectory_start) * step_;
    walker.speed = 0;
    if (walker.down || time > walker.trajectory->end() + rounding) {
        walker.trajectory.reset();
        return;
    }
    const world::Trajectory::State state = walker.trajectory->at(time);
    const double distance = (state.position - walker.position).head<2>().norm();
    walker.position.head<2>() = state.position.head<2>();
    walker.yaw = state.heading.value_or(walker.yaw);
    walker.speed = state.velocity.norm();
    if (distance > 0)
        step_on(walker, distance, distance / step_);
}

void Pedestrians::walk(Walker& walker) const {
    if (walker.down || !walker.walking) {
        walker.speed = 0;
        return;
    }
    const Eigen::Vector2d way = (walker.target - walker.position).head<2>();
    const double left = way.norm();
    const double change = walking_acceleration * step_;
    walker.speed += std::clamp(walker.wanted_speed - walker.speed, -change, change);
    const double distance = std::min(walker.speed * step_, left);
    if (distance > 0) {
        walker.yaw = std::atan2(way.y(), way.x());
        walker.position.head<2>() += way * (distance / left);
        step_on(walker, distance, walker.speed);
    }
    if (distance < left)
        return;
    if (!walker.way.empty()) {  // round a corner
        walker.target = walker.way.back();
        walker.way.pop_back();
        return;
    }
    walker.speed = 0;  // arrived
    walker.walking = false;
}

/// Of the road where cars drive, of the sidewalk beside it, of the last ground elsewhere.
double Pedestrians::ground_height(const Eigen::Vector3d& p_world) const {
    const auto roads = lanes_->at(p_world);
    if (!roads.empty())
        return world::point_at(town_->lanes[roads.front().lane], roads.front().at.s).position.z();
    const auto walkable = lanes_->walkable_at(p_world);
    if (walkable.empty())
        return p_world.z();
    const world::LaneT& lane = town_->lanes[walkable.front().lane];
    const double height = world::point_at(lane, walkable.front().at.s).position.z();
    return height + (is_raised(lane) ? ground::kerb_height : 0);
}

void Pedestrians::nudge(std::uint32_t id, std::string_view field, std::int64_t units) {
    if (double* number = crowd_ ? crowd_->number(id, field) : nullptr) {
        *number = moved_by_units(*number, units);
        return;
    }
    Walker* walker = find(id);
    REPRISE_CHECK(walker != nullptr, "walker " + std::to_string(id));
    const auto move = [&](std::string_view name, double& number) {
        if (field == name)
            number = moved_by_units(number, units);
    };
    move("position.x", walker->position.x());
    move("position.y", walker->position.y());
    move("position.z", walker->position.z());
    move("yaw", walker->yaw);
    move("speed", walker->speed);
    move("phase", walker->phase);
}

std::uint64_t Pedestrians::digest() const {
    world::Hasher hasher;
    hasher.add(static_cast<std::uint64_t>(walkers_.size()));
    for (const Walker& walker : walkers_) {
        hasher.add(walker.id);
        hasher.add(walker.model);
        hasher.add(world::to_vec3(walker.position));
        hasher.add(world::to_vec3(walker.target));
        for (const double value : {walker.yaw, walker.speed, walker.wanted_speed, walker.phase})
            hasher.add(value);
        hasher.add(walker.walking);
        hasher.add(walker.down);
        if (walker.trajectory) {
            walker.trajectory->add_to(hasher);
            hasher.add(walker.trajectory_start);
        }
        for (const Eigen::Vector3d& corner : walker.way)
            hasher.add(world::to_vec3(corner));
    }
    if (crowd_)
        crowd_->add_to(hasher);
    return hasher.digest64();
}

}  // namespace reprise::kernel
