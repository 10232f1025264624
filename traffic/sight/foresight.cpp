// What it must do: tell whether, and where, a body comes into another one in the next seconds.
// What it assumes: as WayAhead: each follows the lanes of its route.
// How it goes: bodies that are metres apart need time, or way, to come together: so many of the
//   next samples are passed over without a look. Those that are near are compared as boxes.
// What it keeps: the bodies that were asked for, until the next look.
#include "traffic/sight/foresight.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reprise::traffic {

namespace {

constexpr double rounding = 1e-6;  // [m]

/// Between the circles around two bodies; negative where these touch. [m]
double gap_between(const BodyBox& one, const BodyBox& other, double radii) {
    return (one.middle - other.middle).norm() - radii - rounding;
}

/// How many of the next samples cannot touch, when two that are `gap` [m] apart come closer by at
/// most `closing` [m] from one to the next.
std::size_t sure_samples(double gap, double closing) {
    return gap <= 0 ? 0 : static_cast<std::size_t>(gap / closing);
}

constexpr std::size_t moments = 4;                           // in each stretch of time
constexpr std::uint32_t of_a_stretch = (1U << moments) - 1;  // a bit each

/// [m] to the corner of a box that is wider and longer by a margin on each side.
double corner(const BodyBox& box, double margin) {
    return std::sqrt((box.half_length + margin) * (box.half_length + margin) +
                     (box.half_width + margin) * (box.half_width + margin));
}

}  // namespace

void Foresight::look(const Car& car, const LaneLines& lines, const RoadGraph& graph, double reach) {
    way_.look(car, lines, graph, reach + 1);
    now_ = way_.at(0);
    speed_ = car.speed;
    reach_ = reach;
    constexpr double each = sample * moments;
    for (std::size_t i = 0; i < stretches; ++i) {
        const double from = i == 0 ? 0 : each * static_cast<double>(i) + sample;
        const double to = each * static_cast<double>(i + 1);
        stretches_[i].from = speed_ * from;
        stretches_[i].to = tried_speed(1) * to;
    }
    way_.surround(stretches_);
    radius_ = corner(now_, 0);
    roomy_radius_ = corner(now_, room);
    most_moved_ = way_.most_moved();
    has_corridor_ = false;
    drives_.known = soon_[0].known = soon_[1].known = sweep_.known = 0;
}

const BodyBox& Foresight::corridor() {
    if (!has_corridor_)
        corridor_ = way_.corridor(reach_, now_.ahead).widened(room);
    has_corridor_ = true;
    return corridor_;
}

const BodyBox& Foresight::drives(std::size_t i) {
    if (i == 0 || speed_ == 0)
        return now_;
    if ((drives_.known >> i & 1U) == 0) {
        drives_.known |= 1U << i;
        drives_.bodies[i] = way_.at(speed_ * sample * static_cast<double>(i));
    }
    return drives_.bodies[i];
}

/// [m/s] of the two that it will have about.
double Foresight::tried_speed(std::size_t which) const {
    return which == 0 ? std::max(speed_, least_speed) : speed_ + speeding_up;
}

const BodyBox& Foresight::soon(std::size_t which, std::size_t i) {
    Row& row = soon_[which];
    if ((row.known >> i & 1U) == 0) {
        row.known |= 1U << i;
        const double tried = tried_speed(which);
        row.bodies[i] =
            (tried == speed_ ? drives(i) : way_.at(tried * sample * static_cast<double>(i)))
                .widened(room);
    }
    return row.bodies[i];
}

/// Bits of the samples at which the two may touch, at whichever of their speeds; 1: now.
std::uint32_t Foresight::moments_near(const Foresight& other) const {
    constexpr double apart = 2 * room;  // [m] more than enough for who has room beside
    std::uint32_t near = 0;
    for (std::size_t i = 0; i < stretches; ++i) {
        const world::Box& own = stretches_[i].area;
        const world::Box& its = other.stretches_[i].area;
        if (own.low.x() <= its.high.x() + apart && its.low.x() <= own.high.x() + apart &&
            own.low.y() <= its.high.y() + apart && its.low.y() <= own.high.y() + apart)
            near |= (i == 0 ? 2 * of_a_stretch + 1 : 2 * of_a_stretch << (i * moments));
    }
    return near;
}

std::span<const BodyBox> Foresight::sweep() {
    if (sweep_.known == 0) {
        sweep_.known = 1;
        for (std::size_t i = 0; i < samples; ++i)
            sweep_.bodies[i] = way_.at(reach_ / (samples - 1) * static_cast<double>(i));
    }
    return sweep_.bodies;
}

/// At both speeds side by side: what one of them says about a moment, less what the other one has
/// driven more or less by then, is true of the other one.
bool Foresight::would_meet(Foresight& other) {
    const std::uint32_t near = moments_near(other);
    const double radii = roomy_radius_ + other.radius_;
    const double its_closing = other.speed_ * other.most_moved_;
    const std::array<double, 2> closing{(tried_speed(0) * most_moved_ + its_closing) * sample,
                                        (tried_speed(1) * most_moved_ + its_closing) * sample};
    const double parting = (tried_speed(1) - tried_speed(0)) * most_moved_ * sample;
    const double gap_now = gap_between(now_, other.now_, radii);
    std::array<std::size_t, 2> next{1 + sure_samples(gap_now, closing[0]),
                                    1 + sure_samples(gap_now, closing[1])};
    for (;;) {
        const std::size_t which = next[1] < next[0] ? 1 : 0;
        const std::size_t sure = next[which];
        if (sure >= samples || near >> sure == 0)
            return false;
        const std::size_t i = sure + static_cast<std::size_t>(std::countr_zero(near >> sure));
        const BodyBox& own = soon(which, i);
        const BodyBox& its = other.drives(i);
        const double gap = gap_between(own, its, radii);
        if (gap <= 0 && overlap(own, its))
            return true;
        next[which] = i + 1 + sure_samples(gap, closing[which]);
        const double gap_of_other = gap - parting * static_cast<double>(i);
        if (gap_of_other > 0)
            next[1 - which] =
                std::max(next[1 - which], i + 1 + sure_samples(gap_of_other, closing[1 - which]));
    }
}

bool Foresight::would_meet(const BodyBox& standing) {
    const double radii = roomy_radius_ + corner(standing, 0);
    for (const std::size_t which : {0U, 1U}) {
        const double speed = tried_speed(which);
        for (std::size_t i = 1; i < samples; ++i) {
            const BodyBox& own = soon(which, i);
            const double gap = gap_between(own, standing, radii);
            if (gap <= 0 && overlap(own, standing))
                return true;
            i += sure_samples(gap, speed * most_moved_ * sample);
        }
    }
    return false;
}

Foresight::Intrusion Foresight::deepest_in(const BodyBox& standing, double reach) const {
    Intrusion deepest;
    for (double s = 0; s <= reach; s += spacing) {
        const BodyBox body = way_.at(s);
        const double there = depth(body, standing);
        const Eigen::Vector2d gap = standing.middle - body.middle;
        if (there > deepest.depth)
            deepest = {there, world::cross(body.ahead, gap) > 0, body.ahead.dot(gap) < 0};
    }
    return deepest;
}

/// Of `others`, with corners at `radius` [m].
Foresight::Entry Foresight::first_on(std::span<const BodyBox> others, double radius) {
    const double radii = roomy_radius_ + radius;
    const double touching = (radii + rounding) * (radii + rounding);
    for (double s = 0; s <= reach_; s += spacing) {
        const BodyBox body = way_.at(s).widened(room);
        double nearest = 1e18;  // [m^2]
        for (const BodyBox& other : others) {
            const double squared = (body.middle - other.middle).squaredNorm();
            if (squared <= touching && overlap(body, other))
                return {s, body, &other == others.data(), true};
            nearest = std::min(nearest, squared);
        }
        const double gap = std::sqrt(nearest) - radii - rounding;
        // Added up one by one: the same places, whatever is passed over.
        for (auto sure = sure_samples(gap, spacing * most_moved_); sure > 0 && s <= reach_; --sure)
            s += spacing;
    }
    return {};
}

Foresight::Entry Foresight::first_on(const BodyBox& standing) {
    return first_on({&standing, 1}, corner(standing, 0));
}

Foresight::Entry Foresight::first_on_way_of(Foresight& other) {
    return first_on(other.sweep(), other.radius_);
}

}  // namespace reprise::traffic
