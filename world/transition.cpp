#include "world/transition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/units.h"

namespace reprise::world {

namespace {

constexpr double pi = std::numbers::pi;

bool is_under_way(double seconds, double duration) {
    return seconds >= 0 && seconds < duration;
}

}  // namespace

double Transition::value(double seconds) const {
    if (seconds >= duration)
        return to;
    if (seconds <= 0)
        return from;
    const double u = seconds / duration;
    double share = u;
    if (shape == Shape::linear && corner > 0) {
        const double full = duration - corner;
        const double left = duration - seconds;
        share = seconds < corner ? seconds * seconds / (2 * corner * full)
                : left < corner  ? 1 - left * left / (2 * corner * full)
                                 : (seconds - corner / 2) / full;
    }
    if (shape == Shape::cubic)
        share = u * u * (3 - 2 * u);
    else if (shape != Shape::linear)
        share = (1 - std::cos(pi * u)) / 2;
    return from + (to - from) * share;
}

double Transition::rate(double seconds) const {
    if (!is_under_way(seconds, duration))
        return 0;
    const double u = seconds / duration;
    const double mean = (to - from) / duration;
    if (shape == Shape::linear)
        return corner > 0 ? (to - from) / (duration - corner) *
                                std::min({seconds / corner, (duration - seconds) / corner, 1.0})
                          : mean;
    return mean * (shape == Shape::cubic ? 6 * u * (1 - u) : pi / 2 * std::sin(pi * u));
}

double Transition::acceleration(double seconds) const {
    if (!is_under_way(seconds, duration))
        return 0;
    if (shape == Shape::linear) {
        const double change = corner > 0 ? (to - from) / ((duration - corner) * corner) : 0;
        return seconds < corner ? change : duration - seconds < corner ? -change : 0;
    }
    const double u = seconds / duration;
    return (to - from) / (duration * duration) *
           (shape == Shape::cubic ? 6 - 12 * u : pi * pi / 2 * std::cos(pi * u));
}

double fastest_rate(Shape shape) {
    switch (shape) {
        case Shape::linear:
            return 1;
        case Shape::cubic:
            return 1.5;
        case Shape::sinusoidal:
        case Shape::step:
            break;
    }
    return pi / 2;
}

double largest_acceleration(Shape shape) {
    switch (shape) {
        case Shape::linear:
            return infinity;
        case Shape::cubic:
            return 6;
        case Shape::sinusoidal:
        case Shape::step:
            break;
    }
    return pi * pi / 2;
}

}  // namespace reprise::world
