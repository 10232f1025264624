// Who is in the crowd: who comes, who was hit, who is taken out.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "walkers/crowd.h"
#include "walkers/posts.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/random.h"

namespace reprise::walkers {

namespace {

using world::Purpose;

}  // namespace

void Crowd::lay_down(const world::TickView& last, std::uint64_t tick) {
    if (last.tick->events() == nullptr)
        return;
    for (const world::Event* event : *last.tick->events()) {
        if (event->kind() != world::EventKind::collision || event->other() < first_walker_id)
            continue;
        const Walker* hit = find(event->other());
        if (hit == nullptr || hit->down_until != 0)
            continue;
        Walker& walker = walkers_[static_cast<std::size_t>(hit - walkers_.data())];
        const double lies =
            5 +
            5 * world::draw(episode_->walker_seed, walker.draws++, Purpose::walker_goal, walker.id);
        walker.down_until = tick + static_cast<std::uint64_t>(lies / step_);
        walker.velocity.setZero();
    }
}

/// Who has lain long enough; and who gets nowhere, as in a corner that no way leads out of: cars
/// would wait for him for ever.
void Crowd::remove_hit_and_lost(OnFoot& next) {
    constexpr double lost_for = 30;  // [s]
    const auto lost_ticks = static_cast<std::uint64_t>(lost_for / step_);
    std::erase_if(walkers_, [&](const Walker& walker) {
        const bool lain = walker.down_until != 0 && next.tick >= walker.down_until;
        const bool lost = walker.down_until == 0 && next.tick > walker.was_at_tick + lost_ticks;
        if (!lain && !lost)
            return false;
        world::EventT event;
        event.kind = world::EventKind::despawned;
        event.actor = walker.id;
        event.position = world::to_vec3(walker.place.position);
        next.events.push_back(std::move(event));
        return true;
    });
}

/// A place on a sidewalk, every metre as likely as the next.
std::optional<Eigen::Vector3d> Crowd::drawn_place(double metre_share, double side_share) const {
    if (ends_.empty())
        return std::nullopt;
    const double metre = metre_share * ends_.back();
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), metre);
    const auto index =
        std::min<std::size_t>(static_cast<std::size_t>(found - ends_.begin()), ends_.size() - 1);
    const world::LaneT& lane = town_->lanes[sidewalks_[index]];
    const world::LanePoint at = world::point_at(lane, metre - (ends_[index] - lane.length));
    const Eigen::Vector2d left = world::left_of(at.yaw) * lane.width * 0.7 * (side_share - 0.5);
    return at.position + Eigen::Vector3d(left.x(), left.y(), ground::kerb_height);
}

void Crowd::fill_up(const world::TickView& last, OnFoot& next) {
    const bool first = next.tick == 1;
    for (unsigned tries = first ? 20 * episode_->walkers : 4;
         walkers_.size() < episode_->walkers && tries > 0;
         --tries) {
        if (!add(last, next))
            continue;
        if (walkers_.back().person.brings_friend && walkers_.size() < episode_->walkers)
            add_friend(next);
        if (!first)
            break;
    }
    if (first && walkers_.size() < episode_->walkers) {
        world::EventT event;
        event.kind = world::EventKind::printed;
        event.text = fmt::format("walkers: {} were asked for, {} has room for {}",
                                 episode_->walkers,
                                 town_->name,
                                 walkers_.size());
        next.events.push_back(std::move(event));
    }
}

/// Somewhere where nobody stands, and which no vehicle with mass sees. False: not there.
bool Crowd::add(const world::TickView& last, OnFoot& next) {
    constexpr double air = 1.5;   // [m] from others
    constexpr double sight = 40;  // [m]
    const auto drawn = [&](std::uint64_t which) {
        return world::draw(
            episode_->walker_seed, 2 * tries_ + which, Purpose::walker_place, next_id_);
    };
    const auto place = drawn_place(drawn(0), drawn(1));
    ++tries_;
    if (!place)
        return false;
    Walker walker;
    walker.id = next_id_;
    walker.person = draw_person(episode_->walker_seed, walker.id, episode_->jaywalkers);
    const auto on_map = ground_->pavement().nearest(*place);
    if (!on_map)
        return false;
    const auto near = [&](const Eigen::Vector3d& p, double reach) {
        return (p - on_map->position).head<2>().norm() < reach;
    };
    for (const Walker& other : walkers_)
        if (near(other.place.position, air))
            return false;
    for (const world::WalkerState& other : next.walkers)
        if (near(world::to_eigen(other.position()), air))
            return false;
    for (const world::VehicleState& vehicle : last.vehicles())
        if (near(world::to_eigen(vehicle.position()), next.tick == 1 ? 5 : sight))
            return false;
    const auto there = map_of(walker.person).nearest(on_map->position);
    if (!there)
        return false;
    walker.place = *there;
    walker.yaw = (2 * drawn(1) - 1) * std::numbers::pi;
    appear(std::move(walker), next);
    return true;
}

/// Beside the one who came last, if there is room.
bool Crowd::add_friend(OnFoot& next) {
    const Walker& leader = walkers_.back();
    Walker walker;
    walker.id = next_id_;
    walker.person = draw_person(episode_->walker_seed, walker.id, episode_->jaywalkers);
    walker.person.jaywalks = leader.person.jaywalks;
    walker.person.road_cost = leader.person.road_cost;
    walker.person.brings_friend = false;
    const Eigen::Vector2d left = beside * world::left_of(leader.yaw);
    walker.place =
        map_of(leader.person)
            .slide(leader.place, leader.place.position + Eigen::Vector3d(left.x(), left.y(), 0));
    for (const Walker& other : walkers_)
        if ((other.place.position - walker.place.position).head<2>().norm() < 0.6)
            return false;
    walker.yaw = leader.yaw;
    walker.friend_of = leader.id;
    // They walk at the pace of the slower one.
    const double pace = std::min(walker.person.speed, leader.person.speed);
    walkers_.back().person.speed = walker.person.speed = pace;
    appear(std::move(walker), next);
    return true;
}

/// The first who walks by a map looks what stands too close to it.
void Crowd::keep_from_posts(const Person& person) {
    bool& known = knows_posts_[person.jaywalks ? 1 : 0];
    if (!known)
        neighbours_.add_posts(posts_beside(map_of(person), ground_->obstacles()));
    known = true;
}

void Crowd::appear(Walker walker, OnFoot& next) {
    keep_from_posts(walker.person);
    walker.place.position.z() = ground_->height(walker.place.position, walker.underfoot);
    walker.was_at_tick = next.tick;
    walker.was_at = walker.place.position.head<2>();
    ++next_id_;
    world::EventT event;
    event.kind = world::EventKind::spawned;
    event.actor = walker.id;
    event.position = world::to_vec3(walker.place.position);
    event.text = world::walker_models()[walker.person.model].name;
    next.events.push_back(std::move(event));
    walkers_.push_back(std::move(walker));
}

}  // namespace reprise::walkers
