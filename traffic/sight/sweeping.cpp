#include "traffic/sight/sweeping.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "traffic/cars/fleet.h"
#include "traffic/sight/braking.h"
#include "traffic/sight/way_ahead.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

/// Whom one may sweep over, driving on.
struct Sweeping::Beside {
    static constexpr double looked_at = 14;  ///< [m] of way

    struct Near {
        BodyBox body;
        double room = 0;            ///< [m] left beside it
        bool never_yields = false;  ///< it has mass, and stands
        bool stands = false;
        Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< of one that drives past

        BodyBox roomy() const { return body.widened(room); }

        /// In so many seconds, if it goes on.
        BodyBox later(double seconds) const {
            BodyBox there = roomy();
            there.middle += seconds * velocity;
            return there;
        }
    };

    std::vector<Near> others;
    std::vector<Near> people;

    void keep_to(const WayAhead& way);

    bool is_empty() const { return others.empty() && people.empty(); }
};

void Sweeping::look() {
    driving_.clear();
    for (const Footprint& one : obstructions_->footprints())
        if (one.drives)
            driving_.push_back(one);
}

/// All that a body may sweep over beside its lane: who stands or hardly moves there.
void Sweeping::gather(const Car& car, bool all, Beside& beside) const {
    constexpr double hair = 0.1;          // [m] left beside it,
    constexpr double finest_hair = 0.03;  // and where those alone are looked at who stand
    constexpr double stands = 0.1;        // [m/s]
    constexpr double slow = 1.5;          // [m/s] of who stays about where he is,
    constexpr double hardly_faster = 5;   // and of one with mass that drives past
    const double around = Beside::looked_at + 2 * world::vehicle_models()[car.model].length;
    const std::span<const Footprint> seen = all ? obstructions_->footprints() : driving_;
    for (const Footprint& one : seen) {
        if ((one.centre - car.rear.head<2>()).squaredNorm() > around * around || one.id == car.id ||
            std::abs(one.z - car.rear.z()) > world::level_clearance)
            continue;
        const double speed = one.velocity.norm();
        if (speed > (one.drives ? hardly_faster : slow))
            continue;
        (one.is_afoot ? beside.people : beside.others)
            .push_back(
                {{one.centre, one.direction, one.half_length, one.half_width},
                 all || speed > stands ? hair : finest_hair,
                 one.drives && speed < stands,
                 speed < stands,
                 all && one.drives && speed > stands ? one.velocity : Eigen::Vector2d(0, 0)});
    }
}

/// What can be swept over on this way. Of who is nearer than a hair already it keeps off the body
/// itself; and where it lies on that, standing helps nobody.
void Sweeping::Beside::keep_to(const WayAhead& way) {
    const BodyBox now = way.at(0);
    const BodyBox corridor = way.corridor(looked_at, now.ahead);
    for (std::vector<Near>* bodies : {&others, &people})
        std::erase_if(*bodies, [&](const Near& one) {
            return one.velocity.isZero() && !overlap(corridor, one.roomy());
        });
    for (Near& one : others)
        if (overlap(now, one.roomy()))
            one.room = 0;
    std::erase_if(others, [&](const Near& one) { return overlap(now, one.roomy()); });
}

double Sweeping::allowed_speed(Car& car, std::uint64_t tick) const {
    constexpr double spacing = 0.5;             // [m]
    constexpr double waits = 40;                // [s]
    constexpr double crawl = 0.6;               // [m/s] people step back from a tail that comes so
    constexpr double creep = 0.1;               // [m/s] before who does not, though it comes so,
    constexpr double deep = 0.15;               // [m] and no further over him than this
    constexpr double least_pace = 2;            // [m/s] that it will have in a moment
    constexpr double lets_out = 5;              // [s] without waiting for him to get out
    constexpr std::uint64_t goes_on_for = 200;  // [ticks]
    constexpr std::uint64_t remembered = 20;    // [ticks]
    if (car.pass)
        return world::infinity;
    const bool is_long = world::vehicle_models()[car.model].length > longest_short_car;
    Beside beside;
    gather(car, is_long && car.brushes_until <= tick, beside);
    if (beside.is_empty())
        return world::infinity;
    const WayAhead way(car, *lines_, *graph_, Beside::looked_at);
    beside.keep_to(way);
    if (beside.is_empty())
        return world::infinity;
    const auto touched = [&](const std::vector<Beside::Near>& bodies, double driven) {
        const BodyBox body = way.at(driven);
        const double time = driven / std::max(car.speed, least_pace);
        return std::find_if(bodies.begin(), bodies.end(), [&](const Beside::Near& other) {
            return overlap(body, other.roomy()) ||
                   (!other.velocity.isZero() && overlap(body, other.later(time)));
        });
    };
    const auto touches = [&](const std::vector<Beside::Near>& bodies, double driven) {
        return touched(bodies, driven) != bodies.end();
    };
    const Braking braking{
        car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
    double allowed = touches(beside.people, 0) ? crawl : world::infinity;
    // Who is held up himself needs time to find a way out; one that stopped he would not mind.
    const BodyBox now = way.at(0);
    const BodyBox soon = way.at(spacing);
    if (std::any_of(beside.people.begin(), beside.people.end(), [&](const Beside::Near& one) {
            return overlap(now, one.body) || (one.stands && overlap(soon, one.body));
        }))
        allowed = std::max(creep, braking.speed_before(0, 0, 0));
    if (car.standing_ticks * step_ < lets_out &&
        std::any_of(beside.people.begin(), beside.people.end(), [&](const Beside::Near& one) {
            return depth(now, one.body) > deep;
        }))
        allowed = braking.speed_before(0, 0, 0);
    const double end = std::min(Beside::looked_at, way.length());
    for (double driven = spacing; driven <= end; driven += spacing) {
        if (!std::isfinite(allowed) && touches(beside.people, driven))
            allowed = std::max(crawl, braking.speed_before(driven - spacing, 0, 0));
        const auto other = touched(beside.others, driven);
        if (other != beside.others.end()) {
            const bool has_waited = car.standing_ticks * step_ > waits && driven <= 2 * spacing;
            if (is_long && has_waited)
                car.brushes_until = tick + goes_on_for;
            if (has_waited && other->never_yields)
                car.wedged_until = tick + remembered;
            return std::min(allowed, braking.speed_before(driven - spacing, 0, 0));
        }
    }
    return allowed;
}

}  // namespace reprise::traffic
