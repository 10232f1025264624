#include "drivers/passing.h"

#include <algorithm>
#include <cmath>

#include "drivers/control/steering.h"

namespace reprise::drivers {

namespace {

constexpr double far_behind = 100;      // [m]
constexpr double far_ahead = 160;       // [m]
constexpr double plan_time = 4;         // [s] before it, at most
constexpr double plan_distance = 14;    // [m]
constexpr double far_wait = 30;         // [m] standing
constexpr double slow_two_wheeler = 7;  // [m/s]
constexpr double slow_walker = 2.5;     // [m/s]
constexpr double crawling = 3;          // [m/s]
constexpr double worth_it = 1.4;        // times as fast is what the road allows
constexpr double for_queue = 40;        // [m] before a junction cars may stand in a queue
constexpr double dark_time = 2.5;       // [s] that one who starts has no foot on the brake, at most
constexpr double before_oncoming = 2;   // [s] longer to wait for the other direction's lane
constexpr double hardly_out = 0.35;     // share of the way aside until which it gives up
constexpr double pass_gain = 0.8;       // [1/s]
constexpr double slow_down = 2;         // [m/s^2]

}  // namespace

void Passing::follow(const world::TickView& last,
                     const Ego& ego,
                     const Way& way,
                     const DrivingStyle& style) {
    stop_s_ = world::infinity;
    missing_room_ = 0;
    cramped_.reset();
    if (!plan_)
        return;
    Bypass& line = plan_->bypass;
    const PassingScene where{last, ego, way, *map_, {}, 0, 0, style.share};
    const double s = where.tracked_s();
    if (s > line.back_end) {
        plan_.reset();
        watched_ = watched_ticks_ = 0;
        return;
    }
    if (s >= line.back_start)
        return;
    look_along(last, ego, way.path(), far_behind, far_ahead, neighbours_);
    const PassingScene scene{last, ego, way, *map_, neighbours_, line.offset(s), 0, style.share};

    // Who moves is passed when it is passed.
    double front = -world::infinity;
    double along = 0;
    for (const Neighbour& one : neighbours_)
        if (std::find(plan_->row.begin(), plan_->row.end(), one.body.id) != plan_->row.end()) {
            front = std::max(front, one.front);
            along = std::max(along, one.along);
        }
    const double length = line.back_end - line.back_start;
    const double passed = front + scene.to_rear() + 1 + 0.5 * along;
    if (s > passed)
        line.back_start = std::min(line.back_start, s + 0.5);
    else if (along > 0.3)
        line.back_start = std::max(line.back_start, passed);
    else
        line.back_start = std::max(std::min(line.back_start, passed + 1), passed);
    line.back_end = line.back_start + length;

    // Not out yet, and somebody comes: not now.
    const double out = (line.offset(s) - line.from) / (line.aside - line.from);
    if ((out < hardly_out && s < line.out_end && !is_free(scene, *plan_)) || has_driven_on(ego))
        come_back(ego, line.offset(s), style);
}

/// Who stood, and was to be passed, is ahead of us again: behind it there is our lane.
bool Passing::has_driven_on(const Ego& ego) const {
    constexpr double moved_up = 3;  // [m]
    if (!plan_->stood_at)
        return false;
    double rear = world::infinity;
    for (const Neighbour& one : neighbours_)
        if (std::find(plan_->row.begin(), plan_->row.end(), one.body.id) != plan_->row.end())
            rear = std::min(rear, one.rear);
    return rear < world::infinity && rear > ego.front_s() && rear > *plan_->stood_at + moved_up;
}

bool Passing::consider(const world::TickView& last,
                       const Ego& ego,
                       const Way& way,
                       std::span<const Overlap> overlaps,
                       double beside,
                       const DrivingStyle& style) {
    if (plan_ && !comes_back())
        return false;
    const auto nearest =
        std::min_element(overlaps.begin(), overlaps.end(), [](const auto& one, const auto& other) {
            return one.s < other.s;
        });
    if (nearest == overlaps.end() || nearest->speed > slow_two_wheeler) {
        watched_ = watched_ticks_ = 0;
        return false;
    }
    look_along(last, ego, way.path(), far_behind, far_ahead, neighbours_);
    // A door is seen as the car that it is of, whichever of them is nearer.
    const Neighbour* first = nullptr;
    for (const Neighbour& one : neighbours_)
        if (one.body.id == nearest->id && (first == nullptr || one.rear < first->rear))
            first = &one;
    if (first == nullptr)
        return false;
    watch(*first);
    const double watched = watched_ticks_ * step_;
    const PassingScene scene{last, ego, way, *map_, neighbours_, beside, watched, style.share};
    const double wait = patience(*first, scene);
    const double gap = nearest->s - ego.front_s();
    // Who waits before a junction looks across it.
    const double sight = ego.speed < 0.5 ? far_wait : plan_distance + plan_time * ego.speed;
    if (wait == world::infinity || gap > sight)
        return false;
    std::optional<PassingPlan> plan = plan_passing(scene, *first);
    if (!plan)
        return false;
    if (std::any_of(way.changes().begin(), way.changes().end(), [&](const LaneChange& change) {
            return change.start < plan->bypass.back_end + 2 && change.end > ego.rear_s();
        }))
        return false;
    const bool oncoming = plan->uses >= PassingPlan::Uses::oncoming_lane;
    const bool may = watched >= wait + (oncoming ? before_oncoming : 0);
    if (may && plan->is_free && plan->missing <= 0) {
        plan_ = std::move(plan);
        if (first->stands())
            plan_->stood_at = first->rear;
        return true;
    }
    if (first->along < 0.3)
        stop_s_ = nearest->s - plan->room;
    if (may && plan->is_free && ego.speed < 0.1)
        missing_room_ = plan->missing;
    if (missing_room_ > 0 && first->body.abandoned &&
        plan->uses != PassingPlan::Uses::oncoming_lane && watched > dark_time)
        cramped_ = std::move(plan);
    return false;
}

void Passing::begin_beside(double s) {
    plan_ = std::move(cramped_);
    cramped_.reset();
    if (!plan_)
        return;
    Bypass& line = plan_->bypass;
    line.out_start = s - 2;
    line.out_end = s - 1;
    line.from = line.aside;
}

void Passing::come_back(const Ego& ego, double beside, const DrivingStyle& style) {
    const double s = ego.rear_axle_s + tracked_ahead(*ego.model);
    PassingPlan home;
    home.speed = home.out_speed = std::max(ego.speed, 3.0);
    home.bypass.aside = home.bypass.from = beside;
    home.bypass.out_start = home.bypass.out_end = home.bypass.back_start = s;
    home.bypass.back_end = s + step_length(*ego.model, beside, home.speed, style.share);
    plan_ = std::move(home);
}

/// Anew when somebody else is ahead, and when the same one begins or ends to look as if nobody were
/// at the wheel: in a queue that moves up the brake lamps go out before the cars go on.
void Passing::watch(const Neighbour& one) {
    const std::uint32_t slow = one.body.speed < slow_two_wheeler ? one.body.id : 0;
    const bool abandoned = one.stands() && one.body.abandoned;
    const bool same = slow == watched_ && abandoned == watched_abandoned_;
    watched_ticks_ = slow == 0 ? 0 : same ? watched_ticks_ + 1 : 1;
    watched_ = slow;
    watched_abandoned_ = abandoned;
}

/// [s] of watching until one knows that somebody will not go on soon, or never faster. Infinity:
/// who waits, or drives.
double Passing::patience(const Neighbour& one, const PassingScene& scene) const {
    const Body& body = one.body;
    const double allowed =
        std::sqrt(scene.share * scene.way.path().at(scene.tracked_s()).squared_speed);
    const bool goes_our_way = one.along > 0.9 * body.speed && allowed > worth_it * one.along;
    switch (body.kind) {
        case BodyKind::prop:
        case BodyKind::door:
            return one.stands() ? 0 : world::infinity;
        case BodyKind::walker:
            if (body.abandoned)
                return 0;
            if (one.stands())
                return 3;
            return goes_our_way && body.speed < slow_walker ? 3 : world::infinity;
        case BodyKind::two_wheeler:
            if (!one.stands())
                return goes_our_way && body.speed < slow_two_wheeler ? 2 : world::infinity;
            break;
        case BodyKind::vehicle:
            if (!one.stands())
                return goes_our_way && body.speed < crawling && has_no_reason(one, scene)
                           ? 8
                           : world::infinity;
            break;
    }
    if (body.abandoned)
        return dark_time;
    return has_no_reason(one, scene) || faces_us(one, scene.way) ? 15 : world::infinity;
}

/// No junction, nobody before it: nothing that a driver would wait for.
bool Passing::has_no_reason(const Neighbour& one, const PassingScene& scene) const {
    const auto near = [&](double s) { return s > one.front - 2 && s < one.front + for_queue; };
    const Way& way = scene.way;
    return std::none_of(way.gates().begin(),
                        way.gates().end(),
                        [&](const Gate& gate) { return near(gate.s); }) &&
           std::none_of(
               scene.neighbours.begin(), scene.neighbours.end(), [&](const Neighbour& other) {
                   return other.body.id != one.body.id && near(other.rear) &&
                          other.rear > one.rear && other.along < 5 && other.left > one.right &&
                          other.right < one.left;
               });
}

double Passing::acceleration(const Ego& ego, const DrivingStyle& style) const {
    // Who comes too near drives up to it, as he would; who stands there comes no nearer.
    constexpr double stands = 0.3;  // [m/s]
    const double room = stop_s_ - ego.front_s();
    const bool too_near = room < -0.5;
    const double stop =
        (too_near && ego.speed > stands) || stop_s_ == world::infinity
            ? world::infinity
            : stop_acceleration(
                  too_near ? 0 : std::max(room, 0.05), ego.speed, style.comfortable_braking, style);
    if (!plan_)
        return stop;
    const double before =
        std::max(plan_->bypass.out_start - ego.rear_axle_s - tracked_ahead(*ego.model), 0.0);
    const bool is_out = ego.rear_axle_s + tracked_ahead(*ego.model) > plan_->bypass.out_end;
    const double most = is_out ? plan_->speed : plan_->out_speed;
    const double allowed = std::sqrt(most * most + 2 * slow_down * style.share * before);
    return std::min(
        stop, std::clamp(pass_gain * (allowed - ego.speed), -3 * style.share, style.acceleration));
}

int Passing::side(const Ego& ego) const {
    if (!plan_)
        return 0;
    const Bypass& line = plan_->bypass;
    const double s = ego.rear_axle_s + tracked_ahead(*ego.model);
    if (plan_->uses == PassingPlan::Uses::own_lane || (s > line.out_end && s < line.back_start))
        return 0;
    return (line.aside > 0) == (s < line.back_start) ? 1 : -1;
}

void Passing::shift(double distance) {
    if (!plan_)
        return;
    plan_->bypass.shift(distance);
    if (plan_->stood_at)
        *plan_->stood_at += distance;
}

void Passing::add_to(world::Hasher& hasher) const {
    if (watched_ == 0 && !plan_)
        return;
    hasher.add(watched_);
    hasher.add(watched_ticks_);
    if (watched_abandoned_)
        hasher.add(watched_abandoned_);
    hasher.add(plan_.has_value());
    if (!plan_)
        return;
    plan_->bypass.add_to(hasher);
    hasher.add(plan_->out_speed);
    hasher.add(plan_->speed);
    hasher.add(std::span<const std::uint32_t>(plan_->row));
    hasher.add(plan_->uses);
    if (plan_->past_waiting)
        hasher.add(plan_->past_waiting);
    if (plan_->stood_at)
        hasher.add(*plan_->stood_at);
}

}  // namespace reprise::drivers
