#include "drivers/bypass.h"

#include <algorithm>
#include <cmath>

namespace reprise::drivers {

namespace {

// The greatest second derivative of the quintic step from 0 to 1, at (3 - sqrt 3) / 6.
constexpr double sharpest_of_step = 5.7735;

/// A step from 0 to 1 with its first and second derivatives, at u in [0, 1]; flat beyond.
struct Step {
    double value = 0;
    double slope = 0;
    double bend = 0;
};

Step quintic(double u) {
    if (u <= 0)
        return {};
    if (u >= 1)
        return {1, 0, 0};
    return {u * u * u * (10 + u * (6 * u - 15)),
            30 * u * u * (1 - u) * (1 - u),
            60 * u * (1 - u) * (1 - 2 * u)};
}

/// Both steps at s, in metres.
Step place(const Bypass& way, double s) {
    const double out = std::max(way.out_end - way.out_start, 0.1);
    const double back = std::max(way.back_end - way.back_start, 0.1);
    const Step first = quintic((s - way.out_start) / out);
    const Step second = quintic((s - way.back_start) / back);
    const double there = way.aside - way.from;
    const double home = way.behind - way.aside;
    return {way.from + there * first.value + home * second.value,
            there * first.slope / out + home * second.slope / back,
            there * first.bend / (out * out) + home * second.bend / (back * back)};
}

}  // namespace

double Bypass::shortest_step(double width, double sharpest) {
    return std::sqrt(sharpest_of_step * std::abs(width) / sharpest);
}

double Bypass::fastest(double width, double length, double lateral_acceleration) {
    return length *
           std::sqrt(lateral_acceleration / (sharpest_of_step * std::max(std::abs(width), 0.01)));
}

double Bypass::offset(double s) const {
    return place(*this, s).value;
}

BesidePath Bypass::beside(double s, double soon) const {
    const Step here = place(*this, s);
    return {here.value, here.slope, here.bend, place(*this, soon).bend};
}

void Bypass::shift(double distance) {
    for (double* s : {&out_start, &out_end, &back_start, &back_end})
        *s += distance;
}

void Bypass::add_to(world::Hasher& hasher) const {
    for (const double number : {out_start, out_end, back_start, back_end, from, aside, behind})
        hasher.add(number);
}

}  // namespace reprise::drivers
