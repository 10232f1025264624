#include "scripting/run/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace reprise::scripting {

namespace {

constexpr double touching = 0.01;  // [m] less is none: bumper to bumper is allowed
constexpr double one_storey = 2;   // [m]

Eigen::Vector2d heading(double yaw) {
    return {std::cos(yaw), std::sin(yaw)};
}

Eigen::Vector2d to_the_left(double yaw) {
    return {-std::sin(yaw), std::cos(yaw)};
}

/// Half of the shadow that it throws on a line of this direction.
double half_shadow(const Footprint& box, const Eigen::Vector2d& axis) {
    return box.half_length * std::abs(heading(box.yaw).dot(axis)) +
           box.half_width * std::abs(to_the_left(box.yaw).dot(axis));
}

}  // namespace

/// Two boxes are apart where their shadows on a side of one of them are.
double overlap(const Footprint& one, const Footprint& other) {
    const Eigen::Vector3d between = other.centre - one.centre;
    if (std::abs(between.z()) > one_storey)
        return 0;
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& axis : std::array{
             heading(one.yaw), to_the_left(one.yaw), heading(other.yaw), to_the_left(other.yaw)}) {
        const double depth = half_shadow(one, axis) + half_shadow(other, axis) -
                             std::abs(between.head<2>().dot(axis));
        least = std::min(least, depth);
    }
    return least > touching ? least : 0;
}

}  // namespace reprise::scripting
