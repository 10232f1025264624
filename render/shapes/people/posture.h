#pragma once

#include <array>

#include <Eigen/Geometry>

#include "world/models/catalogue.h"

namespace reprise::render {

/// Lengths of a body, from its height, age and weight. [m] Shares of the height after Winter,
/// "Biomechanics and Motor Control of Human Movement", 4th ed., ch. 4; children have larger heads
/// and shorter legs.
struct BodyProportions {
    explicit BodyProportions(const world::WalkerModel& model);

    double height;
    double hip;       ///< height of the hip joints when standing
    double half_hip;  ///< between middle and hip joint
    double thigh;     ///< also the length of the shank
    double ankle;     ///< height above the sole
    double foot;      ///< from the ankle to the toes
    double trunk;     ///< from the hips to the shoulders
    double half_shoulder;
    double upper_arm;
    double forearm;
    double head;       ///< chin to crown
    double stoutness;  ///< of arms and legs, 1 is usual
};

/// Of a thigh, trousers included, at the hip. [m]
double thigh_radius(const BodyProportions& body);

/// Where a body's joints are. Frame of the walker: x ahead, y left, z up, origin on the ground
/// between the feet. Index 0 is left, 1 right.
struct Posture {
    Eigen::Vector3d hip;
    double lean = 0;                     ///< [rad] of the trunk, forward
    double twist = 0;                    ///< [rad] of the shoulders, to the left
    std::array<Eigen::Vector3d, 2> toe;  ///< tip of the sole
    std::array<double, 2> pitch{};       ///< [rad] of the feet, toes down
    std::array<Eigen::Vector3d, 2> wrist;

    Eigen::Isometry3d trunk() const;  ///< at the hips, z along it
    Eigen::Vector3d shoulder(const BodyProportions& body, std::size_t side) const;  ///< joint
    Eigen::Vector3d ankle(const BodyProportions& body, std::size_t side) const;
};

/// `habit`: bits that decide how he stands.
Posture standing(const world::WalkerModel& model, std::uint32_t habit);

/// A walker in motion with this speed [m/s] at this phase of the cycle in [0, 1): the left foot
/// touches the ground at 0, the right one at 0.5. While a foot is down, it goes back as fast as the
/// body goes ahead: it does not slide, because the phase counts world::walk_cycle_length().
/// From 2.2 m/s on he runs.
Posture striding(const world::WalkerModel& model, double speed, double phase);

/// The joint between two bones of these lengths that lead from one place to another, bent towards
/// `pole`. A target out of reach is approached as far as the bones go.
Eigen::Vector3d joint_between(const Eigen::Vector3d& from,
                              const Eigen::Vector3d& target,
                              double first,
                              double second,
                              const Eigen::Vector3d& pole);

}  // namespace reprise::render
