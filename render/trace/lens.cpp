// What it must do: take directions to places and places to directions, each the other's inverse to
//   rounding, so that labels of a distorted picture are exact: rays are bent, no picture is.
// How it goes: both models bend the distance from the axis, r (tan of the angle, of a fisheye the
//   angle itself), by r (1 + k1 r^2 + k2 r^4 + ...). Newton's method within bounds undoes it. Where
//   the polynomial turns back the lens ends: two directions would share a place.
// What it keeps: coefficients.
#include "render/trace/lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/external/sensor_attributes.h"

namespace reprise::render {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double widest_tangent = 20;     // of a pinhole: 87 degrees off the axis
constexpr double widest_angle = 3.1;      // [rad] of a fisheye: 178 degrees off the axis
constexpr int steps = 4000;               // in which it is looked for where a lens ends
constexpr double nearly_nothing = 1e-12;  // [focal lengths]
constexpr int most_rounds = 60;           // bisection alone needs no more
constexpr double precise_enough = 1e-14;  // relative

}  // namespace

Lens::Lens(const world::SensorSpec& spec) {
    if (!world::is_camera(spec.kind))
        return;
    fisheye_ = world::attribute(spec, "lens") > 0;
    radial_ = {world::attribute(spec, "k1"),
               world::attribute(spec, "k2"),
               world::attribute(spec, "k3"),
               world::attribute(spec, "k4")};
    tangential_ = {world::attribute(spec, "p1"), world::attribute(spec, "p2")};
    plain_ = !fisheye_ && radial_ == decltype(radial_){} && tangential_ == decltype(tangential_){};
    const double most = fisheye_ ? widest_angle : widest_tangent;
    reach_ = most;
    for (int i = 1; i <= steps && !plain_; ++i)
        if (slope(most * i / steps) <= 0) {
            reach_ = most * (i - 1) / steps;
            break;
        }
    bent_reach_ = bent(reach_);
}

double Lens::bent(double r) const {
    const double r2 = r * r;
    return r * (1 + r2 * (radial_[0] + r2 * (radial_[1] + r2 * (radial_[2] + r2 * radial_[3]))));
}

double Lens::slope(double r) const {
    const double r2 = r * r;
    return 1 + r2 * (3 * radial_[0] +
                     r2 * (5 * radial_[1] + r2 * (7 * radial_[2] + r2 * 9 * radial_[3])));
}

/// The inverse of bent() within the reach.
double Lens::straight(double wanted) const {
    double low = 0;
    double high = reach_;
    double r = std::min(wanted, reach_);
    for (int round = 0; round < most_rounds; ++round) {
        const double off = bent(r) - wanted;
        (off > 0 ? high : low) = r;
        double next = r - off / slope(r);
        if (!(next > low && next < high))
            next = (low + high) / 2;
        const double step = std::abs(next - r);
        r = next;
        if (step <= precise_enough * r)
            break;
    }
    return r;
}

double Lens::radius(double angle) const {
    return angle <= reach_ ? bent(angle) : bent_reach_ * angle / reach_;
}

/// Of a pinhole: radial and tangential.
Vector2d Lens::distorted(const Vector2d& flat) const {
    const double r = flat.norm();
    const double scale = r < nearly_nothing ? 1 : r <= reach_ ? bent(r) / r : bent_reach_ / reach_;
    const double xy = flat.x() * flat.y();
    const Vector2d tangential(
        2 * tangential_[0] * xy + tangential_[1] * (r * r + 2 * flat.x() * flat.x()),
        tangential_[0] * (r * r + 2 * flat.y() * flat.y()) + 2 * tangential_[1] * xy);
    return scale * flat + tangential;
}

Vector2d Lens::place(const Vector3d& p_camera) const {
    if (!fisheye_)
        return distorted(p_camera.head<2>() / p_camera.z());
    const double aside = p_camera.head<2>().norm();
    if (aside < nearly_nothing * std::abs(p_camera.z()))
        return Vector2d::Zero();
    return p_camera.head<2>() * (radius(std::atan2(aside, p_camera.z())) / aside);
}

std::optional<Vector3d> Lens::direction(const Vector2d& place) const {
    const double wanted = place.norm();
    if (fisheye_) {
        if (wanted >= bent_reach_)
            return std::nullopt;
        if (wanted < nearly_nothing)
            return Vector3d::UnitZ();
        const double angle = straight(wanted);
        const Vector2d aside = place * (std::sin(angle) / wanted);
        return Vector3d(aside.x(), aside.y(), std::cos(angle));
    }
    if (wanted >= bent_reach_)
        return std::nullopt;
    Vector2d flat = wanted < nearly_nothing ? place : Vector2d(place * (straight(wanted) / wanted));
    if (tangential_ != decltype(tangential_){}) {
        // Tangential distortion is small: what is left over is taken back as the radial one bends.
        for (int round = 0; round < most_rounds; ++round) {
            const Vector2d off = distorted(flat) - place;
            const double r = flat.norm();
            const double along = r <= reach_ ? slope(r) : 0.0;
            if (along <= 0)
                return std::nullopt;
            const Vector2d out = r < nearly_nothing ? Vector2d::UnitX() : Vector2d(flat / r);
            const double across = r < nearly_nothing ? 1.0 : bent(r) / r;
            const Vector2d radial = out.dot(off) * out;
            flat -= radial / along + (off - radial) / across;
            if (off.norm() <= precise_enough * (1 + r))
                break;
        }
        if ((distorted(flat) - place).norm() > 1e-9)
            return std::nullopt;
    }
    return Vector3d(flat.x(), flat.y(), 1);
}

std::vector<double> Lens::coefficients() const {
    if (fisheye_)
        return {radial_.begin(), radial_.end()};
    return {radial_[0], radial_[1], tangential_[0], tangential_[1], radial_[2]};
}

}  // namespace reprise::render
