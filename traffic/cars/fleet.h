#pragma once

#include <cstdint>
#include <string>

#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

/// SUMO's vehicle types: for every catalogue model one that traffic drives with the model's class
/// and a driver with moods ("d0", "d1", ...), and one for scripted, mirrored and parked cars that
/// may go wherever a passenger car may and has no moods ("s0", ...).
std::string vehicle_types_xml();

std::string demand_type(std::uint16_t model);
std::string scripted_type(std::uint16_t model);

/// The type of what blocks a lane (see stand_ins.h).
std::string stand_in_type();
inline constexpr double stand_in_length = 0.5;  ///< [m]

/// [m/s] sideways of one that changes lanes and is free to choose: a lane in three seconds.
inline constexpr double usual_aside = 1.1;

/// What a driver of the model brakes with when nothing hurries, and at most. [m/s^2]
double comfortable_braking(std::uint16_t model);
double emergency_braking(std::uint16_t model);

/// What may drive where the model's class is asked for.
world::ClassSet model_class(std::uint16_t model);

/// The model for a draw in [0, 1): mostly cars, some vans, few lorries, buses and two-wheelers.
/// `at_home`: the classes that the town's roads are open to; others do not come.
std::uint16_t demand_model(double drawn, world::ClassSet at_home);

/// [m/s] that a car of this model reaches at most.
double top_speed(std::uint16_t model);

/// Metres from the origin (rear axle) to the front bumper, which is where SUMO's positions lie.
double origin_to_front(std::uint16_t model);

}  // namespace reprise::traffic
