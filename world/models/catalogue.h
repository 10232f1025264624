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
    lamp_reverse = 16,
    lamp_beacon = 32  ///< the blue lamps of an emergency service
};

enum class BodyStyle : std::uint8_t {
    hatchback,
    sedan,
    suv,
    van,
    lorry,
    bus,
    wagon,
    coupe,
    pickup,
    minibus,
    motorcycle,  ///< from here on two-wheelers, with their rider
    bicycle
};

inline bool is_two_wheeler(BodyStyle body) {
    return body >= BodyStyle::motorcycle;
}

/// Whose service a vehicle is painted for.
enum class Livery : std::uint8_t { plain, taxi, police, ambulance };

/// A vehicle model: real dimensions of a typical vehicle of its kind. [m], [kg], [W], [N].
/// A two-wheeler's `height` and `mass` are with its rider; its `track` is the physics' alone, which
/// knows four wheels (world/models/car_model.h).
struct VehicleModel {
    const char* name;
    BodyStyle body;
    Livery livery;
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

/// Has it blue lamps?
inline bool has_beacon(const VehicleModel& model) {
    return model.livery == Livery::police || model.livery == Livery::ambulance;
}

/// The vehicle catalogue. An index into it is what ticks record: append only.
std::span<const VehicleModel> vehicle_models();

/// Index in vehicle_models().
std::optional<std::uint16_t> find_vehicle_model(std::string_view name);

enum class Age : std::uint8_t { child, teen, adult, senior };

enum class Clothing : std::uint8_t {
    casual,  ///< shirt or pullover, long trousers
    shorts,
    skirt,
    dress,
    gown,  ///< down to the ankles
    coat,
    suit,
    sportswear,
    uniform,  ///< one colour, with a belt
    workwear  ///< with a reflecting vest
};

enum class Hair : std::uint8_t { bald, cropped, bob, loose, bun, cap, hat, helmet, scarf };

/// A pedestrian model: body, pace and kind of clothes. [m], [kg]. Colours and what he carries are
/// his look's, see render/shapes/people/wardrobe.h.
struct WalkerModel {
    const char* name;
    double height;
    double shoulder_width;
    double mass;
    double walking_speed;  ///< [m/s]
    double girth;          ///< around the waist
    Age age;
    Clothing clothing;
    Hair hair;
};

/// The pedestrian catalogue. Append only.
std::span<const WalkerModel> walker_models();

/// Index in walker_models().
std::optional<std::uint16_t> find_walker_model(std::string_view name);

/// All names of these catalogues and of the props', for messages.
std::vector<std::string> model_names();

}  // namespace reprise::world
