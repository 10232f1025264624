#include "walkers/threats.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "world/check.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::walkers {

namespace {

constexpr double foresight = 1;     // [s]
constexpr double margin = 0.3;      // [m] that nobody likes a car to come nearer
constexpr double rolls = 0.3;       // [m/s]
constexpr double crawls = 0.05;     // [m/s] of a long one, whose tail comes sideways all the same
constexpr double long_one = 7;      // [m]
constexpr double turns = 0.07;      // [rad] within that time
constexpr double widest = 1;        // [m] radius of anybody on foot
constexpr double step_aside = 0.7;  // [m] that one thinks of

bool comes(double speed, std::uint16_t model) {
    return std::abs(speed) >= (world::vehicle_models()[model].length > long_one ? crawls : rolls);
}

/// Where the bumper goes: told by how the body turns between it and the rear axle. A rear axle that
/// comes from aside comes onto that line, and not farther.
struct BumperWay {
    Eigen::Vector2d place;
    Eigen::Vector2d direction;

    BumperWay(const RoadUser& car, double curvature) {
        const world::VehicleModel& model = world::vehicle_models()[car.model];
        const double to_bumper = model.length - model.rear_overhang;
        const double aside = curvature * to_bumper + std::sin(car.course - car.yaw);
        place = car.rear_axle + to_bumper * world::ahead_of(car.yaw);
        direction = world::ahead_of(car.yaw + std::asin(std::clamp(aside, -1.0, 1.0)));
    }

    Eigen::Vector2d not_beyond(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
        const double before = world::cross(direction, from - place);
        const double behind = world::cross(direction, to - place);
        return before * behind < 0 ? Eigen::Vector2d(to - behind * world::turned_left(direction))
                                   : to;
    }
};

}  // namespace

void Threats::add(const RoadUser& car) {
    if (!comes(car.speed, car.model))
        return;
    // Who brakes is seen to brake; that somebody may step on it is not thought of.
    const double braking = car.speed * car.acceleration < 0 ? std::abs(car.acceleration) : 0;
    const double time =
        braking > 0 ? std::min(foresight, std::abs(car.speed) / braking) : foresight;
    const auto way = [&](double t) {
        return std::copysign(std::abs(car.speed) * t - braking * t * t / 2, car.speed);
    };
    // Who starts in a bend turns faster the faster he is: his tail comes before it is seen to.
    const double gaining = car.speed * car.acceleration > 0 ? std::abs(car.acceleration) : 0;
    const auto way_in_bend = [&](double t) {
        return way(t) + std::copysign(gaining * t * t / 2, car.speed);
    };
    const double curvature = car.yaw_rate / car.speed;
    if (std::abs(curvature * way_in_bend(time)) < turns) {
        add_box(car, std::min(0.0, way(time)), std::max(0.0, way(time)));
        return;
    }
    // Who turns does not go where he points to, and the tail swings out: a bus's by more than a
    // metre, over the kerb.
    const BumperWay bumper(car, curvature);
    for (const double t : {0.0, time / 4, time / 2, 3 * time / 4, time}) {
        const double turned = curvature * way_in_bend(t);
        RoadUser then = car;
        then.yaw += turned;
        then.rear_axle += way_in_bend(t) * world::ahead_of(car.course + turned / 2);
        then.rear_axle = bumper.not_beyond(car.rear_axle, then.rear_axle);
        add_box(then, 0, 0);
    }
}

/// What its body covers, and so many metres behind and ahead of it.
void Threats::add_box(const RoadUser& car, double rear, double front) {
    const world::VehicleModel& body = world::vehicle_models()[car.model];
    const Eigen::Vector2d ahead = world::ahead_of(car.yaw);
    const double middle = body.length / 2 - body.rear_overhang;
    Threat threat{car.rear_axle + middle * ahead,
                  ahead,
                  -body.length / 2 + rear,
                  body.length / 2 + front,
                  body.width / 2};
    // Of most walkers most threats are far away: two comparisons tell.
    const double beside = threat.half_width + widest + margin;
    for (const double end : {threat.rear - widest - margin, threat.front + widest + margin})
        threat.around.take(threat.middle + end * ahead, beside);
    threats_.push_back(threat);
}

void Threats::look(std::span<const RoadUser> users) {
    threats_.clear();
    for (const RoadUser& user : users)
        add(user);
    sort();
}

void Threats::sort() {
    keys_.clear();
    widest_ = 0;
    for (std::uint32_t i = 0; i < threats_.size(); ++i) {
        const world::Box& around = threats_[i].around;
        keys_.push_back({around.low.x(), i});
        widest_ = std::max(widest_, around.high.x() - around.low.x());
    }
    std::sort(keys_.begin(), keys_.end());
}

template <typename See>
void Threats::near(const Eigen::Vector2d& p, double reach, See&& see) const {
    constexpr double rounding = 1e-6;  // [m]
    auto key =
        std::lower_bound(keys_.begin(), keys_.end(), Key{p.x() - widest_ - reach - rounding, 0});
    for (; key != keys_.end() && key->west <= p.x() + reach; ++key) {
        const Threat& threat = threats_[key->index];
        if (p.x() >= threat.around.low.x() - reach && p.x() <= threat.around.high.x() + reach &&
            p.y() >= threat.around.low.y() - reach && p.y() <= threat.around.high.y() + reach)
            see(threat, key->index);
    }
}

/// [m] from the nearest side of what they pass over; negative: inside.
double Threats::clearance(const Eigen::Vector2d& p) const {
    double least = world::infinity;
    near(p, step_aside, [&](const Threat& threat, std::uint32_t) {
        const Eigen::Vector2d from = p - threat.middle;
        const double along = from.dot(threat.ahead);
        const double beyond = std::max(along - threat.front, threat.rear - along);
        const double beside = std::abs(world::cross(threat.ahead, from)) - threat.half_width;
        const double outside = std::hypot(std::max(beyond, 0.0), std::max(beside, 0.0));
        least = std::min(least, outside > 0 ? outside : std::max(beyond, beside));
    });
    return least;
}

bool Threats::come_near(const Eigen::Vector2d& p, double radius) const {
    const double room = radius + margin;
    bool any = false;
    near(p, 0, [&](const Threat& threat, std::uint32_t) {
        const Eigen::Vector2d from = p - threat.middle;
        const double along = from.dot(threat.ahead);
        any = any || (along >= threat.rear - room && along <= threat.front + room &&
                      std::abs(world::cross(threat.ahead, from)) < threat.half_width + room);
    });
    return any;
}

std::optional<Eigen::Vector2d> Threats::way_out(const Eigen::Vector2d& p, double radius) const {
    return way_out(p, radius, [](const Eigen::Vector2d& there) { return there; });
}

std::optional<Eigen::Vector2d> Threats::way_out(const Eigen::Vector2d& p,
                                                double radius,
                                                const Reach& reach) const {
    REPRISE_CHECK(radius <= widest, std::to_string(radius));
    const double room = radius + margin;
    std::optional<Eigen::Vector2d> across_it;
    double nearest = 0;
    std::uint32_t first = 0;  // of those that are as near the first one counts
    near(p, 0, [&](const Threat& threat, std::uint32_t index) {
        const Eigen::Vector2d from = p - threat.middle;
        const double along = from.dot(threat.ahead);
        if (along < threat.rear - room || along > threat.front + room)
            return;
        const Eigen::Vector2d left = world::turned_left(threat.ahead);
        const double across = from.dot(left);
        const double gap = std::abs(across) - threat.half_width - room;
        if (gap < nearest || (across_it && gap == nearest && index < first)) {
            nearest = gap;
            first = index;
            across_it = across < 0 ? Eigen::Vector2d(-left) : left;
        }
    });
    if (!across_it)
        return std::nullopt;
    // Across the nearest one; another way only where that would lead into the next.
    constexpr double better = 0.1;  // [m]
    Eigen::Vector2d best = *across_it;
    double clear = clearance(reach(p + step_aside * best));
    const Eigen::Vector2d left = world::turned_left(*across_it);
    for (const double aside : {1.0, -1.0})
        for (const double on : {1.0, 0.0}) {
            const Eigen::Vector2d way = (on * *across_it + aside * left).normalized();
            const double there = clearance(reach(p + step_aside * way));
            if (there <= clear + better)
                continue;
            clear = there;
            best = way;
        }
    return best;
}

double Threats::to_between(const Eigen::Vector2d& p,
                           const Eigen::Vector2d& way,
                           double radius,
                           const Reach& reach) const {
    constexpr int steps = 8;
    constexpr double step = 0.1;    // [m]
    constexpr double nearer = 0.1;  // [m] than at best, before it counts
    constexpr double spare = 0.05;  // [m]
    double best = clearance(p);
    double best_at = 0;
    double last = best;
    for (int i = 1; i <= steps; ++i) {
        last = clearance(reach(p + i * step * way));
        if (last <= best)
            continue;
        best = last;
        best_at = i * step;
    }
    return last < best - nearer && best > radius + spare ? best_at : world::infinity;
}

}  // namespace reprise::walkers
