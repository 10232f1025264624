// How they walk: along their ways, as far as gates let them, around each other, out of the way of
// cars.
#include <algorithm>
#include <cmath>

#include "walkers/crowd.h"
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
constexpr double stride = 0.7;        // [m] that one thinks of who gets out of the way
constexpr double turn_rate = 5;       // [rad/s] of somebody on his feet

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

}  // namespace

bool Crowd::is_out_of_patience(const Walker& walker) {
    const bool marked = walker.gate >= walker.gates.size() || walker.gates[walker.gate].marked;
    return walker.waited > (marked ? patience : patience_elsewhere);
}

/// Where he would go if he were alone: along his way, as far as the next gate lets him.
void Crowd::want(Walker& walker, std::uint64_t tick) {
    constexpr std::uint32_t hopeless = 160;  // ticks in somebody's way
    constexpr double met = 4;                // [m]
    walker.wanted.setZero();
    walker.may_enter = false;
    if (walker.down_until != 0 || tick < walker.pause_until)
        return;
    const Eigen::Vector2d p = walker.place.position.head<2>();
    const std::uint64_t idle = tick - walker.was_at_tick;
    const Walker* other = walker.meets && !walker.on_road ? find(walker.friend_of) : nullptr;
    if (other != nullptr && is_near_friend(walker, *other, met))
        walker.corner = walker.way.size();  // from here on together
    if (walker.corner >= walker.way.size() || is_out_of_patience(walker) ||
        walker.stuck > hopeless || (idle > 0 && idle % hopeless == 0))
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
        walker.waited = walker.lets = walker.let_for = 0;
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
    walker.may_enter = may_enter(gate, pace, lights_, traffic_) && !lets_one_go(walker, gate);
    if (walker.may_enter)
        return speed;
    if (left < 2)
        ++walker.waited;
    return std::min(speed, std::max(0.0, 1.5 * (left - hold)));
}

/// Where people keep crossing who drives would wait for all of them: of those who come to the kerb
/// while he has stood for long each lets him go first, for as long as he may take to notice.
bool Crowd::lets_one_go(Walker& walker, const Gate& gate) const {
    constexpr std::uint32_t at_most = 200;  // ticks, most of them for who still is on the road
    if (!gate.marked || !gate.signals.empty() || walker.let_for > at_most)
        return false;
    if (walker.let_for == 0)
        for (const Conflict& conflict : gate.conflicts)
            if (walker.lets == 0)
                walker.lets = traffic_.long_waiting(conflict);
    if (walker.lets == 0)
        return false;
    const bool is_gone =
        std::none_of(gate.conflicts.begin(), gate.conflicts.end(), [&](const Conflict& conflict) {
            return traffic_.is_before(conflict, walker.lets);
        });
    walker.let_for = is_gone ? at_most + 1 : walker.let_for + 1;
    return !is_gone && walker.let_for <= at_most;
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
    neighbours_.around(self, near, {}, around_);
    for (const Body& body : around_) {
        const Walker* other = find(body.id);
        const Eigen::Vector2d gap = self.place - body.place;
        if (other == nullptr || !other->on_road || other->wanted.dot(gap) <= 0)
            continue;
        walker.wanted = pace * gap.normalized();
        return;
    }
}

/// Who stands on a way over a junction: those in the lanes before it have no need to turn.
void Crowd::look_at_stopped() {
    constexpr double stands = 0.2;  // [m/s]
    stopped_.clear();
    for (const RoadUser& user : users_.all())
        if (std::abs(user.speed) < stands && user.lane < town_->lanes.size() &&
            town_->lanes[user.lane].kind == world::LaneKind::internal)
            stopped_.push_back(user);
}

/// Who waits at the kerb for a while with somebody's flank at his knees steps back from it, and
/// stays there: that one may have to turn where he stands, and wait for him as he does for that
/// one.
void Crowd::step_back(Walker& walker) const {
    constexpr std::uint32_t patience_beside = 60;  // ticks of waiting
    constexpr double room = 1;                     // [m]
    constexpr double stays = 0.3;                  // [m] beyond
    constexpr double pace = 0.6;                   // [m/s]
    if (walker.waited < patience_beside || walker.may_enter || walker.entered)
        return;
    const Eigen::Vector2d p = walker.place.position.head<2>();
    for (const RoadUser& user : stopped_) {
        const world::VehicleModel& body = world::vehicle_models()[user.model];
        const Eigen::Vector2d ahead = world::ahead_of(user.yaw);
        const Eigen::Vector2d from =
            p - user.rear_axle - (body.length / 2 - body.rear_overhang) * ahead;
        const double along = from.dot(ahead);
        const double left = world::cross(ahead, from);
        const double past_end = along - std::clamp(along, -body.length / 2, body.length / 2);
        const double beside = left - std::clamp(left, -body.width / 2, body.width / 2);
        const double gap = std::hypot(past_end, beside) - walker.person.radius;
        if (gap > room + stays)
            continue;
        Eigen::Vector2d away = past_end * ahead + beside * world::turned_left(ahead);
        if (away.isZero())  // whose tail lies over him
            away = std::copysign(1.0, left) * world::turned_left(ahead);
        walker.wanted =
            gap > room ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(pace * away.normalized());
        return;
    }
}

/// Who gets nowhere for long squeezes past the post that leaves no room.
Neighbours::From Crowd::keeps_from(const Walker& walker) {
    constexpr std::uint32_t squeezes = 60;  // ticks in its way
    return {walker.on_road, walker.stuck < squeezes};
}

void Crowd::avoid(Walker& walker) {
    if (walker.wanted.squaredNorm() < 1e-6)
        return;
    const Body self{
        walker.place.position.head<2>(), walker.velocity, walker.person.radius, walker.id};
    neighbours_.around(self, elbow_reach, keeps_from(walker), around_);
    if (!around_.empty())
        walker.wanted = steering_.choose(self, walker.wanted, around_);
}

/// Who got out of a bus's way does not walk back while its tail still comes over the kerb.
bool Crowd::walks_into_threat(const Walker& walker) const {
    constexpr double stops_within = 0.3;  // [s]
    if (walker.wanted.isZero())
        return false;
    const Eigen::Vector2d p = walker.place.position.head<2>();
    return threats_.come_near(p + stops_within * walker.wanted, walker.person.radius);
}

/// Where he comes who goes straight to `there`: to a wall, and along it, or to a kerb.
Eigen::Vector2d Crowd::reached(const Walker& walker, const Eigen::Vector2d& there) {
    const WalkMap::Place to =
        map_of(walker.person)
            .slide(walker.place, {there.x(), there.y(), walker.place.position.z()});
    return (is_allowed(walker, to) ? to : walker.place).position.head<2>();
}

/// [m/s] Who gets out of one's way stops before he is in that of another.
double Crowd::flight_pace(const Walker& walker, const Eigen::Vector2d& way) {
    constexpr double hurry = 2.5;   // [m/s]
    constexpr double stopping = 3;  // [m/s^2] of what he could
    const auto reach = [&](const Eigen::Vector2d& there) { return reached(walker, there); };
    const double left =
        threats_.to_between(walker.place.position.head<2>(), way, walker.person.radius, reach);
    return std::min(hurry, std::sqrt(2 * stopping * left));
}

/// Nobody stands still, or goes on, where a car is about to be; and those behind him let him.
void Crowd::flee() {
    constexpr double gets_away = 0.2;  // [m] of a stride
    constexpr int ranks = 3;           // who stands behind those who stand behind
    bool any = false;
    for (Walker& walker : walkers_) {
        walker.flees = walker.cornered = false;
        if (walker.down_until != 0)
            continue;
        const auto reach = [&](const Eigen::Vector2d& there) { return reached(walker, there); };
        const Eigen::Vector2d p = walker.place.position.head<2>();
        if (const auto way = threats_.way_out(p, walker.person.radius, reach)) {
            walker.wanted = flight_pace(walker, *way) * *way;
            walker.flees = any = true;
            walker.cornered = (reached(walker, p + stride * *way) - p).norm() < gets_away;
        } else if (!walker.on_road && walks_into_threat(walker)) {
            walker.wanted.setZero();
        }
    }
    for (int rank = 0; rank < ranks && any; ++rank) {
        any = false;
        for (const Walker& walker : walkers_)
            if (walker.flees && give_room_to(walker))
                any = true;
    }
}

/// The way out of his way: the same way, unless a wall leaves more room along it. Who stands in a
/// corner of it would stay there, and he between that one and the car.
Eigen::Vector2d Crowd::way_from(const Walker& other, const Walker& fleeing) {
    constexpr double better = 0.2;  // [m]
    const Eigen::Vector2d p = other.place.position.head<2>();
    const Eigen::Vector2d same = fleeing.wanted.normalized();
    Eigen::Vector2d best = same;
    double farthest = -better;
    for (const double angle : {0.0, 0.8, -0.8, 1.6, -1.6}) {
        const Eigen::Vector2d way = turned(same, angle);
        const Eigen::Vector2d there = reached(other, p + stride * way);
        const double far = (there - fleeing.place.position.head<2>()).norm();
        if (far <= farthest + better)
            continue;
        farthest = far;
        best = way;
    }
    return fleeing.wanted.norm() * best;
}

/// Whoever is in his way gets out of it, unless he gets out of a car's himself.
bool Crowd::give_room_to(const Walker& fleeing) {
    constexpr double arm = 0.3;  // [m] between the two
    const Body self{
        fleeing.place.position.head<2>(), fleeing.velocity, fleeing.person.radius, fleeing.id};
    neighbours_.around(self, 2 * self.radius + arm, {}, around_);
    bool any = false;
    for (const Body& body : around_) {
        const Walker* found = find(body.id);
        const Eigen::Vector2d gap = body.place - self.place;
        if (found == nullptr || (found->flees && !found->cornered) || found->down_until != 0 ||
            gap.dot(fleeing.wanted) < 0.5 * gap.norm() * fleeing.wanted.norm())
            continue;
        Walker& other = walkers_[static_cast<std::size_t>(found - walkers_.data())];
        other.wanted = way_from(other, fleeing);
        other.cornered = false;
        other.flees = any = true;
    }
    return any;
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
            !neighbours_.is_clear(self, to.position.head<2>(), keeps_from(walker)))
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
        walker.place.position.z() = ground_->height(walker.place.position, walker.underfoot);
        const double height = world::walker_models()[walker.person.model].height;
        if (speed > 1e-3)
            walker.phase += way.norm() / world::walk_cycle_length(speed, height);
        walker.phase -= std::floor(walker.phase);
    }
}

}  // namespace reprise::walkers
