#include "render/shapes/people/posture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/shapes/cars/car_outline.h"
#include "render/shapes/fast_math.h"
#include "world/models/gait.h"

namespace reprise::render {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double turn = 2 * std::numbers::pi;

Eigen::AngleAxisd pitched(double angle) {
    return {angle, Vector3d::UnitY()};
}

/// How the feet move in a cycle.
struct Gait {
    Gait(const world::WalkerModel& model, double speed)
        : body(model),
          cycle(world::walk_cycle_length(speed, model.height)),
          run(static_cast<double>(smooth_step(1.9F, 2.5F, static_cast<float>(speed)))),
          stance(0.62 - 0.30 * run),
          lift((0.018 + 0.13 * run) * model.height) {}

    double toe_x(double phase) const;
    double toe_z(double phase) const;
    double pitch(double phase) const;
    Vector3d ankle(double phase) const;
    double reach(double phase) const;

    BodyProportions body;
    double cycle;   ///< [m]
    double run;     ///< 0 walks, 1 runs
    double stance;  ///< share of the cycle that a foot is on the ground
    double lift;    ///< [m] of the toes in mid-swing
};

/// Of the tip of the sole, relative to the hips.
double Gait::toe_x(double phase) const {
    const double reached = cycle * stance / 2;
    const double ahead = 0.55 * body.foot - 0.08 * run * cycle;
    if (phase < stance)
        return ahead + reached - cycle * phase;
    // A cubic that leaves and meets the ground at the ground's speed.
    const double u = (phase - stance) / (1 - stance);
    const double slope = -cycle * (1 - stance);
    const double rise = u * u * (3 - 2 * u);
    return ahead - reached + 2 * reached * rise + slope * u * (1 - u) * (1 - 2 * u);
}

double Gait::toe_z(double phase) const {
    if (phase < stance)
        return body.foot * std::max(0.0, std::sin(-pitch(phase)));
    const double u = (phase - stance) / (1 - stance);
    const double bump = std::sin(std::numbers::pi * u);
    return lift * bump * bump + body.foot * u * u * std::max(0.0, std::sin(-pitch(phase)));
}

double Gait::pitch(double phase) const {
    static constexpr std::array<Knot, 8> walking{{{0, -.30F},
                                                  {.09F, 0},
                                                  {.36F, 0},
                                                  {.62F, .95F},
                                                  {.68F, .90F},
                                                  {.80F, .10F},
                                                  {.92F, -.30F},
                                                  {1, -.30F}}};
    static constexpr std::array<Knot, 7> running{
        {{0, -.05F}, {.05F, 0}, {.14F, 0}, {.32F, 1.0F}, {.55F, 1.3F}, {.85F, .1F}, {1, -.05F}}};
    const auto at = static_cast<float>(phase);
    const auto walk = static_cast<double>(interpolate(walking, at));
    return walk + run * (static_cast<double>(interpolate(running, at)) - walk);
}

Vector3d Gait::ankle(double phase) const {
    return Vector3d(toe_x(phase), 0, toe_z(phase)) +
           pitched(pitch(phase)) * Vector3d(-body.foot, 0, body.ankle);
}

/// Height of the hips at which this leg is almost straight.
double Gait::reach(double phase) const {
    const Vector3d foot = ankle(phase);
    const double leg = 2 * body.thigh * 0.99;
    return foot.z() + std::sqrt(std::max(0.0, leg * leg - foot.x() * foot.x()));
}

double hip_height(const Gait& gait, double phase) {
    constexpr int samples = 8;
    double low = gait.body.hip;
    for (int i = 0; i <= samples; ++i)
        low = std::min(low, gait.reach(gait.stance * i / samples));
    // A foot also reaches far right after it left the ground and before it comes down.
    for (const double swinging : {gait.stance + 0.03, gait.stance + 0.06, 0.92, 0.95, 0.98})
        low = std::min(low, gait.reach(swinging));
    const double free = std::max(0.0, gait.reach(gait.stance / 2) - low);
    // Walking, the body is highest over the standing foot; running, between the steps.
    const double walk = low + 0.5 * free * (0.5 - 0.5 * std::cos(2 * turn * (phase - 0.06)));
    const double run =
        low - 0.025 * gait.body.height +
        0.035 * gait.body.height * (0.5 - 0.5 * std::cos(2 * turn * (phase - gait.stance / 2)));
    return walk + gait.run * (run - walk);
}

/// Where the hand is when the arm swings forward by `swing` and the elbow bends by `bend`. [rad]
Vector3d hand_at(const Posture& posture,
                 const BodyProportions& body,
                 std::size_t side,
                 double swing,
                 double bend) {
    const double out = side == 0 ? 1 : -1;
    const Vector3d elbow(body.upper_arm * std::sin(swing),
                         out * 0.10 * body.upper_arm,
                         -body.upper_arm * std::cos(swing));
    const Vector3d wrist(body.forearm * std::sin(swing + bend),
                         -out * 0.02 * body.forearm,
                         -body.forearm * std::cos(swing + bend));
    return posture.shoulder(body, side) + elbow + wrist;
}

double stoop(const world::WalkerModel& model) {
    return model.age == world::Age::senior ? 0.20 : 0.03;
}

}  // namespace

BodyProportions::BodyProportions(const world::WalkerModel& model) : height(model.height) {
    const double child = std::clamp((1.6 - height) / 0.7, 0.0, 1.0);
    head = 0.178 + 0.036 * height;
    hip = (0.53 - 0.055 * child) * height;
    half_hip = 0.050 * height;
    ankle = 0.043 * height;
    thigh = (hip - ankle) / 2 / 0.997;
    foot = 0.118 * height;
    trunk = height - head - 0.040 * height - hip;
    half_shoulder = 0.405 * model.shoulder_width;
    const double shoulder = hip + trunk;
    upper_arm = 0.222 * shoulder;
    forearm = 0.180 * shoulder;
    stoutness = std::sqrt(model.mass / (22.5 * height * height));
}

double thigh_radius(const BodyProportions& body) {
    return .055 * body.height * body.stoutness;
}

Isometry3d Posture::trunk() const {
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = hip;
    pose.rotate(pitched(lean));
    pose.rotate(Eigen::AngleAxisd(twist, Vector3d::UnitZ()));
    return pose;
}

Vector3d Posture::shoulder(const BodyProportions& body, std::size_t side) const {
    return trunk() * Vector3d(0, (side == 0 ? 1 : -1) * body.half_shoulder, body.trunk);
}

Vector3d Posture::ankle(const BodyProportions& body, std::size_t side) const {
    return toe[side] + pitched(pitch[side]) * Vector3d(-body.foot, 0, body.ankle);
}

Posture standing(const world::WalkerModel& model, std::uint32_t habit) {
    const BodyProportions body(model);
    Posture posture;
    const double shift = habit % 3 == 0 ? 0 : (habit % 3 == 1 ? 0.012 : -0.012) * body.height;
    posture.hip = {0, shift, body.hip - 0.002 * body.height - std::abs(shift) * 0.3};
    posture.lean = stoop(model);
    for (std::size_t side : {0U, 1U}) {
        const double out = side == 0 ? 1 : -1;
        const double ahead = (habit >> 2U) % 2 == side ? 0.02 : -0.015;
        posture.toe[side] = {
            body.foot + (ahead - 0.005) * body.height, out * 1.05 * body.half_hip, 0};
        posture.wrist[side] = hand_at(posture, body, side, 0.04, 0.22);
    }
    if ((habit >> 4U) % 4 == 0)  // hands folded in front
        for (std::size_t side : {0U, 1U})
            posture.wrist[side] = posture.trunk() * Vector3d(0.12 * body.height,
                                                             (side == 0 ? .02 : -.02) * body.height,
                                                             0.10 * body.height);
    return posture;
}

Posture striding(const world::WalkerModel& model, double speed, double phase) {
    const Gait gait(model, speed);
    const BodyProportions& body = gait.body;
    Posture posture;
    const double sway = 0.012 * body.height * (1 - gait.run);
    posture.hip = {0, sway * std::sin(turn * (phase + 0.19)), hip_height(gait, phase)};
    posture.lean = stoop(model) + 0.03 + 0.11 * gait.run;
    const double vigour = std::clamp(0.35 + speed / 2.2, 0.0, 1.0);
    posture.twist = -0.10 * vigour * std::cos(turn * phase);
    for (std::size_t side : {0U, 1U}) {
        const double out = side == 0 ? 1 : -1;
        const double own = side == 0 ? phase : phase - 0.5 - std::floor(phase - 0.5);
        posture.toe[side] = {gait.toe_x(own), out * 0.75 * body.half_hip, gait.toe_z(own)};
        posture.pitch[side] = gait.pitch(own);
        // Arms swing against the legs.
        const double swing = -(0.40 + 0.25 * gait.run) * vigour * std::cos(turn * own);
        const double bend = 0.28 + 0.25 * std::max(0.0, swing) + 1.25 * gait.run;
        posture.wrist[side] = hand_at(posture, body, side, swing - 0.15 * gait.run, bend);
    }
    return posture;
}

Vector3d joint_between(const Vector3d& from,
                       const Vector3d& target,
                       double first,
                       double second,
                       const Vector3d& pole) {
    const Vector3d way = target - from;
    const double reach = first + second;
    const double distance = std::clamp(way.norm(), std::abs(first - second) + 1e-4, reach - 1e-6);
    const Vector3d along = way.normalized();
    const Vector3d across = (pole - along * along.dot(pole)).normalized();
    const double ahead = (first * first - second * second + distance * distance) / (2 * distance);
    const double aside = std::sqrt(std::max(0.0, first * first - ahead * ahead));
    return from + along * ahead + across * aside;
}

}  // namespace reprise::render
