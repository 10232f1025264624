#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reprise::world {

/// Lamp bits of VehicleState.lamps, CarState.lamps and Control.lamps.
enum Lamp : std::uint16_t {
    lamp_brake = 1,
    lamp_left = 2,
    lamp_right = 4,
    lamp_low_beam = 8,
    lamp_reverse = 16
};

enum class BodyStyle : std::uint8_t { hatchback, sedan, suv, van, lorry, bus };

/// A vehicle model: real dimensions of a typical car of its kind. [m], [kg], [W], [N].
struct VehicleModel {
    const char* name;
    BodyStyle body;
    double length;
    double width;
    double height;
    double wheelbase;
    double rear_overhang;  ///< rear bumper to rear axle
    double wheel_radius;
    double track;  ///< between the wheel centres of an axle
    double mass;
    double power;               ///< at the wheels
    double max_drive_force;     ///< at the wheels, in first gear
    double max_steering_angle;  ///< [rad] of the front wheels
    double drag_area;           ///< cd * A [m^2]
    const char* sumo_class;     ///< SUMO's vehicle class
};

/// The vehicle catalogue. An index into it is what ticks record: append only.
std::span<const VehicleModel> vehicle_models();

/// Index in vehicle_models().
std::optional<std::uint16_t> find_vehicle_model(std::string_view name);

struct WalkerModel {
    const char* name;
    double height;
    double shoulder_width;
    double mass;
    double walking_speed;  ///< [m/s]
};

/// The pedestrian catalogue. Append only.
std::span<const WalkerModel> walker_models();

/// Index in walker_models().
std::optional<std::uint16_t> find_walker_model(std::string_view name);

/// All names of both catalogues, for messages.
std::vector<std::string> model_names();

}  // namespace reprise::world
