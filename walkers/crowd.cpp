#include "walkers/crowd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "walkers/things.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/gait.h"
#include "world/random.h"

namespace reprise::walkers {

namespace {

using ground::Surface;
using world::Purpose;

constexpr double elbow_reach = 3;     // [m] whom one walks around
constexpr double corner_reach = 0.4;  // [m] where the way on is clear; else
constexpr double at_corner = 0.05;    // [m]
constexpr double acceleration = 4;    // [m/s^2] people stop within half a second
constexpr double turn_rate = 5;       // [rad/s] of somebody on his feet
constexpr double beside = 0.8;        // [m] between two who walk together
constexpr unsigned plans_a_tick = 4;  // ways found in one tick, behind the first

Surface more_road(Surface one, Surface other) {
    for (const Surface surface : {Surface::road, Surface::crossing})
        if (one == surface || other == surface)
            return surface;
    return Surface::sidewalk;
}

Eigen::Vector2d turned(const Eigen::Vector2d& v, double angle) {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
}

/// What everybody keeps, in one piece: a digest of many small ones costs more.
struct WalkerDigest {
    std::uint32_t id;
    std::uint32_t polygon;
    std::array<double, 9> numbers;
    std::array<std::uint64_t, 9> counts;
};

static_assert(sizeof(WalkerDigest) == 152, "no padding");

}  // namespace

Crowd::Crowd(const world::EpisodeT& episode,
             const world::TownT& town,
             const world::LaneMap& lanes,
             WalkingGround& ground)
    : episode_(&episode),
      town_(&town),
      lanes_(&lanes),
      ground_(&ground),
      step_(world::seconds(1, episode.step_ns)),
      traffic_(town, lanes),
      lights_(town) {
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        if (town.lanes[i].kind != world::LaneKind::sidewalk)
            continue;
        sidewalks_.push_back(i);
        ends_.push_back((ends_.empty() ? 0 : ends_.back()) + town.lanes[i].length);
    }
}

const WalkMap& Crowd::map_of(const Person& person) {
    return person.jaywalks ? ground_->streets() : ground_->pavement();
}

const Crowd::Walker* Crowd::find(std::uint32_t id) const {
    const auto at = std::lower_bound(
        walkers_.begin(), walkers_.end(), id, [](const Walker& one, std::uint32_t wanted) {
            return one.id < wanted;
        });
    return at != walkers_.end() && at->id == id ? &*at : nullptr;
}

void Crowd::advance(const world::TickView& last, world::TickDraft& next) {
    const std::uint64_t tick = next.tick.index;
    plans_ = 0;

    // Who was hit, who leaves, who comes.
    lights_.look(next);
    traffic_.look(last, next);
    threats_.look(last, next, step_);
    lay_down(last, tick);
    remove_hit_and_lost(next);
    fill_up(last, next);

    // Everybody as the others see him.
    neighbours_.clear();
    for (const world::WalkerState& walker : next.traffic.walkers)
        neighbours_.add({{walker.position().x(), walker.position().y()},
                         static_cast<double>(walker.speed()) *
                             world::ahead_of(static_cast<double>(walker.yaw())),
                         world::walker_models()[walker.model()].shoulder_width / 2,
                         walker.id()},
                        false);
    on_road_.clear();
    for (Walker& walker : walkers_) {
        const Eigen::Vector2d place = walker.place.position.head<2>();
        neighbours_.add({place, walker.velocity, walker.person.radius, walker.id}, false);
        walker.on_road = map_of(walker.person).surface(walker.place) != Surface::sidewalk;
        if (walker.on_road)
            on_road_.push_back(place);
    }
    add_things(last, next, on_road_, neighbours_);
    neighbours_.sort();

    // Where to, around whom, and the step.
    for (Walker& walker : walkers_) {
        walker.body = neighbours_.index_of(walker.id);
        want(walker, tick);
    }
    for (Walker& walker : walkers_) {
        make_way(walker);
        avoid(walker);
        flee(walker);
    }
    for (Walker& walker : walkers_) {
        step(walker, tick);
        watch(walker, tick);
    }
    for (const Walker& walker : walkers_)
        write(walker, next);
}

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
void Crowd::remove_hit_and_lost(world::TickDraft& next) {
    constexpr double lost_for = 30;  // [s]
    const auto lost_ticks = static_cast<std::uint64_t>(lost_for / step_);
    std::erase_if(walkers_, [&](const Walker& walker) {
        const bool lain = walker.down_until != 0 && next.tick.index >= walker.down_until;
        const bool lost =
            walker.down_until == 0 && next.tick.index > walker.was_at_tick + lost_ticks;
        if (!lain && !lost)
            return false;
        world::EventT event;
        event.kind = world::EventKind::despawned;
        event.actor = walker.id;
        event.position = world::to_vec3(walker.place.position);
        next.tick.events.push_back(std::move(event));
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

void Crowd::fill_up(const world::TickView& last, world::TickDraft& next) {
    const bool first = next.tick.index == 1;
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
        next.tick.events.push_back(std::move(event));
    }
}

/// Somewhere where nobody stands, and which no vehicle with mass sees. False: not there.
bool Crowd::add(const world::TickView& last, world::TickDraft& next) {
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
    for (const world::WalkerState& other : next.traffic.walkers)
        if (near(world::to_eigen(other.position()), air))
            return false;
    for (const world::VehicleState& vehicle : last.vehicles())
        if (near(world::to_eigen(vehicle.position()), next.tick.index == 1 ? 5 : sight))
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
bool Crowd::add_friend(world::TickDraft& next) {
    const Walker& leader = walkers_.back();
    Walker walker;
    walker.id = next_id_;
    walker.person = draw_person(episode_->walker_seed, walker.id, episode_->jaywalkers);
    walker.person.jaywalks = leader.person.jaywalks;
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

void Crowd::appear(Walker walker, world::TickDraft& next) {
    walker.place.position.z() = ground_->height(walker.place.position);
    walker.was_at_tick = next.tick.index;
    walker.was_at = walker.place.position.head<2>();
    ++next_id_;
    world::EventT event;
    event.kind = world::EventKind::spawned;
    event.actor = walker.id;
    event.position = world::to_vec3(walker.place.position);
    event.text = world::walker_models()[walker.person.model].name;
    next.tick.events.push_back(std::move(event));
    walkers_.push_back(std::move(walker));
}

/// To his own side of the straightest way, which everybody else takes as well; where the way is as
/// clear there.
void Crowd::keep_to_side(const WalkMap& map,
                         const Walker& walker,
                         std::vector<WalkMap::Step>& way) {
    WalkMap::Place before = walker.place;
    for (std::size_t i = 1; i + 1 < way.size(); ++i) {
        const Eigen::Vector2d in = (way[i].position - way[i - 1].position).head<2>().normalized();
        const Eigen::Vector2d out = (way[i + 1].position - way[i].position).head<2>().normalized();
        const Eigen::Vector2d right = -world::turned_left(in + out).normalized();
        const auto corner = map.nearest(way[i].position);
        if (!corner)
            continue;
        WalkMap::Place at = *corner;
        if (right.allFinite()) {
            const Eigen::Vector2d aside = walker.person.side * right;
            const WalkMap::Place there =
                map.slide(at, at.position + Eigen::Vector3d(aside.x(), aside.y(), 0));
            // Over the end of a crossing that he does not take he would not get.
            if (map.is_clear(before, there.position, way[i - 1].surface) &&
                map.is_clear(there, way[i + 1].position, way[i].surface))
                at = there;
        }
        way[i].position = at.position;
        before = at;
    }
}

bool Crowd::take_way(Walker& walker, const WalkMap::Place& goal) {
    const WalkMap& map = map_of(walker.person);
    auto way = map.path(walker.place, goal);
    if (!way || way->size() < 2)
        return false;
    keep_to_side(map, walker, *way);
    walker.way = std::move(*way);
    walker.corner = 1;
    walker.gates = gates_of(walker.way, *town_, *lanes_, lights_, traffic_);
    walker.gate = 0;
    walker.waited = walker.stuck = 0;
    return true;
}

/// A new way, of those that the seed draws the first that leads somewhere; later if there is none.
void Crowd::plan(Walker& walker, std::uint64_t tick) {
    constexpr double nearest_goal = 40;  // [m]
    constexpr double farthest_goal = 300;
    constexpr int most_tries = 12;
    if (tick > 1 && ++plans_ > plans_a_tick)
        return;
    walker.way.clear();
    walker.gates.clear();
    const Walker* leader = walker.friend_of != 0 ? find(walker.friend_of) : nullptr;
    if (leader != nullptr && leader->down_until == 0) {
        if (leader->way.empty())
            return;
        const Eigen::Vector3d& there = leader->way.back().position;
        if ((there - walker.place.position).norm() < 3) {  // the other one comes
            walker.pause_until = tick + static_cast<std::uint64_t>(1 / step_);
            return;
        }
        const auto goal = map_of(walker.person).nearest(there);
        walker.person.side = leader->person.side - beside;
        if (goal && take_way(walker, *goal))
            return;
    }
    walker.friend_of = 0;
    const auto drawn = [&] {
        return world::draw(episode_->walker_seed, walker.draws++, Purpose::walker_goal, walker.id);
    };
    for (int i = 0; i < most_tries; ++i) {
        const double metre = drawn();
        const auto place = drawn_place(metre, drawn());
        if (!place)
            break;
        const double far = (*place - walker.place.position).head<2>().norm();
        if ((far < nearest_goal || far > farthest_goal) && i + 3 < most_tries)
            continue;
        const auto goal = map_of(walker.person).nearest(*place);
        if (goal && take_way(walker, *goal))
            return;
    }
    walker.pause_until = tick + static_cast<std::uint64_t>(5 / step_);
}

/// Where he would go if he were alone: along his way, as far as the next gate lets him.
void Crowd::want(Walker& walker, std::uint64_t tick) {
    constexpr std::uint32_t patience = 1800;  // ticks at a gate
    constexpr std::uint32_t hopeless = 160;   // ticks in somebody's way
    walker.wanted.setZero();
    walker.may_enter = false;
    if (walker.down_until != 0 || tick < walker.pause_until)
        return;
    const Eigen::Vector2d p = walker.place.position.head<2>();
    const std::uint64_t idle = tick - walker.was_at_tick;
    if (walker.corner >= walker.way.size() || walker.waited > patience || walker.stuck > hopeless ||
        (idle > 0 && idle % hopeless == 0))
        plan(walker, tick);
    while (walker.corner < walker.way.size()) {
        const Eigen::Vector2d gap = walker.way[walker.corner].position.head<2>() - p;
        const Eigen::Vector2d leg =
            (walker.way[walker.corner].position - walker.way[walker.corner - 1].position).head<2>();
        if (gap.norm() > corner_reach && (gap.norm() > 2 * corner_reach || gap.dot(leg) > 0))
            break;
        // Who cuts a corner of the map would walk against its edge, and stay there.
        const auto most =
            more_road(walker.way[walker.corner - 1].surface, walker.way[walker.corner].surface);
        if (gap.norm() > at_corner && walker.corner + 1 < walker.way.size() &&
            !map_of(walker.person)
                 .is_clear(walker.place, walker.way[walker.corner + 1].position, most))
            break;
        ++walker.corner;
    }
    if (walker.corner >= walker.way.size()) {
        // There. Some stay for a while.
        if (!walker.way.empty() && walker.friend_of == 0) {
            const double drawn =
                world::draw(episode_->walker_seed, walker.draws++, Purpose::walker_goal, walker.id);
            if (drawn < 0.3)
                walker.pause_until = tick + static_cast<std::uint64_t>(50 * drawn / step_);
        }
        walker.way.clear();
        return;
    }
    const Eigen::Vector2d gap = walker.way[walker.corner].position.head<2>() - p;
    Eigen::Vector2d ahead = gap.normalized();
    double speed = walker.person.speed;
    // Two together: who is ahead waits a little, who is behind hurries.
    if (const Walker* leader = walker.friend_of != 0 ? find(walker.friend_of) : nullptr) {
        const double behind = (leader->place.position.head<2>() - p).dot(ahead);
        speed *= std::clamp(1 + 0.4 * behind, 0.6, 1.3);
    }
    speed = speed_at_gate(walker, speed);
    // In somebody's way for a while: to one side, the id says which.
    if (walker.stuck > 30 && (walker.stuck / 20) % 2 == 1)
        ahead = turned(ahead, ((walker.id + walker.stuck / 40) % 2 == 0 ? 1.2 : -1.2));
    walker.wanted = speed * ahead;
}

/// [m/s] Slower before a gate that is shut, and on the road before a lane where a car comes.
double Crowd::speed_at_gate(Walker& walker, double speed) {
    constexpr double hold = 0.2;         // [m] before the road
    constexpr double on_the_kerb = 0.3;  // [m] along a gate, where it still is pavement
    constexpr std::uint32_t asked = 60;  // ticks of waiting, behind which one trusts in brakes
    while (walker.gate < walker.gates.size()) {
        const Gate& gate = walker.gates[walker.gate];
        // Only of who has walked up to it: elsewhere in town its far side is just a direction.
        const bool behind = !walker.on_road && walker.corner > gate.first &&
                            gate.progress(walker.place.position) > gate.length() / 2;
        const bool on_the_next = walker.gate + 1 < walker.gates.size() &&
                                 walker.gates[walker.gate + 1].first == gate.last &&
                                 walker.corner > gate.last;
        if (!behind && !on_the_next && (walker.corner <= gate.last + 1 || walker.on_road))
            break;
        ++walker.gate;
        walker.waited = 0;
        walker.entered = false;
    }
    if (walker.gate >= walker.gates.size())
        return speed;
    const Gate& gate = walker.gates[walker.gate];
    Pace pace{gate.progress(walker.place.position), speed, Trust::none};
    // Ends of crossings lie on the pavement: who comes off one may stand on that of another, and
    // who waits there may have found himself another way, which begins on the crossing.
    walker.entered = walker.on_road && (walker.entered || pace.progress >= on_the_kerb);
    if (walker.entered) {
        pace.trust = gate.marked ? Trust::seen : Trust::none;
        pace.on_road = true;
        return must_hold(gate, pace, traffic_) ? 0 : speed * 1.1;
    }
    // Past the corner that it begins at, who is beside it must not walk along the kerb to get
    // there.
    const double left = walker.corner > gate.first
                            ? std::max(0.0, -pace.progress)
                            : (gate.from - walker.place.position).head<2>().norm();
    const bool is_next = walker.corner >= gate.first;
    if (!is_next || left > 1.5 + speed)
        return speed;
    if (gate.marked && (!gate.signals.empty() || walker.waited > asked))
        pace.trust = gate.signals.empty() ? Trust::all : Trust::seen;
    pace.progress = std::min(pace.progress, 0.0);
    walker.may_enter = may_enter(gate, pace, lights_, traffic_);
    if (walker.may_enter) {
        return speed;
    }
    if (left < 2)
        ++walker.waited;
    return std::min(speed, std::max(0.0, 1.5 * (left - hold)));
}

/// Does he get on, or wait as he should?
void Crowd::watch(Walker& walker, std::uint64_t tick) {
    constexpr double on = 1;  // [m]
    const Eigen::Vector2d p = walker.place.position.head<2>();
    const bool waits = tick < walker.pause_until || walker.waited > 0 || walker.way.empty();
    if ((walker.entered || !waits) && (p - walker.was_at).norm() < on)
        return;
    walker.was_at = p;
    walker.was_at_tick = tick;
}

/// Who waits at the end of a crossing steps back from those who come off it: there they all pass
/// the same corner.
void Crowd::make_way(Walker& walker) {
    constexpr double near = 1.2;  // [m]
    constexpr double pace = 0.6;  // [m/s]
    if (walker.waited == 0 || walker.may_enter || walker.on_road)
        return;
    const Body self{
        walker.place.position.head<2>(), walker.velocity, walker.person.radius, walker.id};
    neighbours_.around(self, near, false, around_);
    for (const Body& body : around_) {
        const Walker* other = find(body.id);
        const Eigen::Vector2d gap = self.place - body.place;
        if (other == nullptr || !other->on_road || other->wanted.dot(gap) <= 0)
            continue;
        walker.wanted = pace * gap.normalized();
        return;
    }
}

void Crowd::avoid(Walker& walker) {
    if (walker.wanted.squaredNorm() < 1e-6)
        return;
    const Body self{
        walker.place.position.head<2>(), walker.velocity, walker.person.radius, walker.id};
    neighbours_.around(self, elbow_reach, walker.on_road, around_);
    if (!around_.empty())
        walker.wanted = steering_.choose(self, walker.wanted, around_);
}

/// Nobody stands still, or goes on, where a car is about to be.
void Crowd::flee(Walker& walker) const {
    constexpr double hurry = 2.5;  // [m/s]
    if (walker.down_until != 0)
        return;
    if (const auto way = threats_.way_out(walker.place.position.head<2>(), walker.person.radius))
        walker.wanted = hurry * *way;
}

/// Nobody steps onto a road whose gate does not let him.
bool Crowd::is_allowed(const Walker& walker, const WalkMap::Place& place) {
    const WalkMap& map = map_of(walker.person);
    return walker.may_enter || walker.on_road || map.surface(place) == Surface::sidewalk;
}

void Crowd::step(Walker& walker, std::uint64_t tick) {
    const WalkMap& map = map_of(walker.person);
    const Eigen::Vector2d from = walker.place.position.head<2>();
    Eigen::Vector2d change = walker.wanted - walker.velocity;
    const double most = acceleration * step_;
    if (change.norm() > most)
        change *= most / change.norm();
    const Eigen::Vector2d velocity = walker.velocity + change;
    const Body self{from, walker.velocity, walker.person.radius, walker.id};
    // Straight on, or past whoever is there by now, or not at all.
    bool moved = false;
    for (const double angle : {0.0, 0.6, -0.6, 1.2, -1.2}) {
        if (walker.down_until != 0 || velocity.norm() < 1e-3)
            break;
        const Eigen::Vector2d way = step_ * turned(velocity, angle);
        const WalkMap::Place to =
            map.slide(walker.place, walker.place.position + Eigen::Vector3d(way.x(), way.y(), 0));
        if (!is_allowed(walker, to) ||
            !neighbours_.is_clear(self, to.position.head<2>(), walker.on_road))
            continue;
        walker.place = to;
        moved = true;
        break;
    }
    const Eigen::Vector2d way = walker.place.position.head<2>() - from;
    walker.velocity = moved ? Eigen::Vector2d(way / step_) : Eigen::Vector2d(0, 0);
    neighbours_.move(walker.body, walker.place.position.head<2>());

    const double speed = walker.velocity.norm();
    const bool blocked = !walker.way.empty() && walker.down_until == 0 &&
                         tick >= walker.pause_until && walker.waited == 0 && speed < 0.2;
    walker.stuck = blocked ? walker.stuck + 1 : walker.stuck - std::min(walker.stuck, 2U);
    if (speed > 0.15) {
        const double aim = std::atan2(walker.velocity.y(), walker.velocity.x());
        const double turn = world::wrap_angle(aim - walker.yaw);
        walker.yaw =
            world::wrap_angle(walker.yaw + std::clamp(turn, -turn_rate * step_, turn_rate * step_));
    }
    if (moved) {
        walker.place.position.z() = ground_->height(walker.place.position);
        const double height = world::walker_models()[walker.person.model].height;
        if (speed > 1e-3)
            walker.phase += way.norm() / world::walk_cycle_length(speed, height);
        walker.phase -= std::floor(walker.phase);
    }
}

void Crowd::write(const Walker& walker, world::TickDraft& next) const {
    using world::rounded;
    const Eigen::Vector3d& p = walker.place.position;
    next.traffic.walkers.emplace_back(
        world::Vec3(rounded(p.x(), 1024), rounded(p.y(), 1024), rounded(p.z(), 1024)),
        static_cast<float>(rounded(walker.yaw, 8192)),
        static_cast<float>(rounded(walker.velocity.norm(), 1024)),
        static_cast<float>(std::floor(walker.phase * 8192) / 8192),
        walker.id,
        walker.person.model,
        walker.down_until != 0,
        std::uint8_t{0},
        walker.person.look);
}

double* Crowd::number(std::uint32_t id, std::string_view field) {
    const Walker* found = find(id);
    if (found == nullptr)
        return nullptr;
    Walker& walker = walkers_[static_cast<std::size_t>(found - walkers_.data())];
    return field == "position.x"   ? &walker.place.position.x()
           : field == "position.y" ? &walker.place.position.y()
           : field == "position.z" ? &walker.place.position.z()
           : field == "yaw"        ? &walker.yaw
           : field == "speed"      ? &walker.velocity.x()
           : field == "phase"      ? &walker.phase
                                   : nullptr;
}

void Crowd::add_to(world::Hasher& hasher) const {
    hasher.add(next_id_);
    hasher.add(tries_);
    lights_.add_to(hasher);
    for (const Walker& walker : walkers_) {
        const Eigen::Vector3d& p = walker.place.position;
        hasher.add(WalkerDigest{walker.id,
                                walker.place.polygon,
                                {p.x(),
                                 p.y(),
                                 p.z(),
                                 walker.velocity.x(),
                                 walker.velocity.y(),
                                 walker.yaw,
                                 walker.phase,
                                 walker.was_at.x(),
                                 walker.was_at.y()},
                                {walker.way.size(),
                                 walker.corner,
                                 2 * walker.gate + (walker.entered ? 1 : 0),
                                 walker.waited,
                                 walker.stuck,
                                 walker.pause_until,
                                 walker.was_at_tick,
                                 walker.down_until,
                                 walker.draws}});
        if (!walker.way.empty())
            hasher.add(world::to_vec3(walker.way.back().position));
    }
}

}  // namespace reprise::walkers
