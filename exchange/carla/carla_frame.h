#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace reprise::exchange {

/// UE4 wrote vectors as floats, UE5 writes doubles; the header says nothing of it.
enum class CarlaVariant : std::uint8_t { ue4, ue5 };

enum class CarlaKind : std::uint8_t { other, vehicle, walker, traffic_light };

/// A place in CARLA's frame: left-handed, x ahead or east, y right or south, z up.
struct CarlaPose {
    std::uint32_t actor = 0;
    Eigen::Vector3d location;  ///< [cm]
    Eigen::Vector3d rotation;  ///< [degrees] roll, pitch (nose up), yaw (clockwise from above)
};

struct CarlaActor {
    CarlaPose pose;  ///< where it was when it was added
    CarlaKind kind = CarlaKind::other;
    std::string blueprint;  ///< such as vehicle.tesla.model3
    std::map<std::string, std::string> attributes;
};

struct CarlaCollision {
    std::uint32_t actor = 0;
    std::uint32_t other = 0;
};

enum class CarlaColor : std::uint8_t { red, yellow, green, off, unknown };

struct CarlaLight {
    std::uint32_t actor = 0;
    CarlaColor color = CarlaColor::unknown;
};

struct CarlaControl {
    std::uint32_t actor = 0;
    double brake = 0;  ///< [0, 1]
    std::int32_t gear = 0;
};

struct CarlaLamps {
    std::uint32_t actor = 0;
    std::uint32_t flags = 0;  ///< bits of carla.VehicleLightState
};

struct CarlaMotion {
    std::uint32_t actor = 0;
    Eigen::Vector3d velocity;  ///< [m/s], CARLA's axes
};

struct CarlaBox {
    std::uint32_t actor = 0;
    Eigen::Vector3d middle;  ///< [cm] of an actor: in its frame; of a trigger: in the world's
    Eigen::Vector3d extent;  ///< [cm] half of each side
};

/// One frame of a log: what changed, and where everybody is.
struct CarlaFrame {
    std::uint64_t number = 0;
    double elapsed = 0;  ///< [s] since recording began
    std::vector<CarlaActor> added;
    std::vector<std::uint32_t> removed;
    std::vector<CarlaCollision> collisions;
    std::vector<CarlaPose> poses;
    std::vector<CarlaLight> lights;
    std::vector<CarlaControl> controls;
    std::vector<CarlaLamps> lamps;
    std::vector<CarlaMotion> motions;
    std::vector<CarlaBox> boxes;
    std::vector<CarlaBox> triggers;  ///< of traffic lights: where those stand who wait for them
};

}  // namespace reprise::exchange
