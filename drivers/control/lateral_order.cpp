#include "drivers/control/lateral_order.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/models/motion_limits.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

constexpr double comfort = 1.5;         // [m/s^2] sideways of one who is told no time
constexpr double hard = 5;              // [m/s^2] at the corners of a linear change
constexpr double slowest = 2;           // [m/s] below it a time says nothing about a way
constexpr double steepest_slope = 0.5;  // that a course is fed forward with
constexpr double sharpest_bend = 0.1;   // [1/m]
constexpr double longest_change = 60;   // [s]

}  // namespace

void LateralOrder::set_offset(double offset, double duration, world::Shape shape) {
    kept_ = offset;
    come_over(duration, shape);
}

void LateralOrder::come_over(double duration, world::Shape shape) {
    is_new_ = true;
    change_ = {0, kept_, duration, shape};
}

void LateralOrder::begin(std::uint64_t tick,
                         double beside,
                         const world::CarModel& car,
                         double speed,
                         double road_friction) {
    if (!is_new_)
        return;
    is_new_ = false;
    changes_ = true;
    start_ = tick;
    change_.from = beside;
    const double distance = change_.to - change_.from;
    if (change_.shape == world::Shape::step) {
        change_.shape = world::Shape::sinusoidal;
        change_.duration = world::quickest_shift(
            car, distance, change_.shape, std::max(speed, slowest), road_friction);
    } else if (change_.duration <= 0) {
        const double likes = std::numbers::pi * std::sqrt(std::abs(distance) / (2 * comfort));
        change_.duration =
            std::max({1.0,
                      likes,
                      world::quickest_shift(
                          car, distance, change_.shape, std::max(speed, slowest), road_friction)});
    }
    change_.duration = std::min(change_.duration, longest_change);
    if (change_.shape == world::Shape::linear)
        change_.corner =
            std::min(change_.duration / 3, std::abs(distance) / change_.duration / hard);
}

double LateralOrder::seconds(std::uint64_t tick, double step) const {
    return static_cast<double>(tick - start_) * step;
}

int LateralOrder::side(std::uint64_t tick, double step) const {
    if (!changes_ || seconds(tick, step) >= change_.duration)
        return 0;
    return change_.to > change_.from ? 1 : -1;
}

double LateralOrder::offset(std::uint64_t tick, double step, double later) const {
    return changes_ ? change_.value(seconds(tick, step) + later) : kept_;
}

std::optional<BesidePath> LateralOrder::beside(std::uint64_t tick,
                                               double step,
                                               double speed,
                                               double ahead) const {
    if (empty())
        return std::nullopt;
    if (!changes_)
        return BesidePath{kept_, 0, 0, 0};
    const double along = std::max(speed, slowest);
    const double then = seconds(tick, step) + ahead / along;
    const auto bend = [&](double at) {
        return std::clamp(
            change_.acceleration(at) / (along * along), -sharpest_bend, sharpest_bend);
    };
    BesidePath place;
    place.offset = change_.value(then);
    place.slope = std::clamp(change_.rate(then) / along, -steepest_slope, steepest_slope);
    place.bend = bend(then);
    place.bend_soon = bend(then + BesidePath::preview);
    return place;
}

void LateralOrder::end(std::uint64_t tick, double step) {
    if (changes_ && seconds(tick, step) > change_.duration)
        changes_ = false;
}

void LateralOrder::add_to(world::Hasher& hasher) const {
    if (empty())
        return;
    hasher.add(kept_);
    hasher.add(is_new_);
    hasher.add(changes_);
    for (const double number : {change_.from, change_.to, change_.duration, change_.corner})
        hasher.add(number);
    hasher.add(change_.shape);
    hasher.add(start_);
}

}  // namespace reprise::drivers
