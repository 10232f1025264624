#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace reprise::exchange {

/// Where the bytes of a log are: `read` fills its argument from an offset on; the range lies in it.
struct CarlaBytes {
    std::string name;  ///< for messages
    std::uint64_t size = 0;
    std::function<void(std::uint64_t, std::span<std::uint8_t>)> read;
};

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

/// Where a log stops making sense.
struct CarlaDamage {
    std::uint64_t offset = 0;
    std::string what;
};

/// Reads a recording of CARLA's recorder frame by frame, in bounded memory: a window of 1 MB, or
/// one packet where that is larger, 64 MB at most. Packets of unknown kind are stepped over.
class CarlaLog {
  public:
    /// Reads the header and finds the variant. Throws world::Error, "x.log: byte N: ...", when this
    /// is no such log.
    explicit CarlaLog(CarlaBytes bytes);
    ~CarlaLog();
    CarlaLog(CarlaLog&&) noexcept;

    const std::string& map() const;
    std::int64_t date() const;  ///< [s] since 1970, UTC
    CarlaVariant variant() const;

    /// The next whole frame, or null at the end or where the log is damaged. Lives until the next
    /// call.
    const CarlaFrame* next();

    /// From the first frame again.
    void rewind();

    /// What ended the log before its end; nothing when it is whole as far as it was read.
    const std::optional<CarlaDamage>& damage() const;

    /// Bytes of the header and of the whole frames read so far.
    std::uint64_t offset() const;

    /// How many packets of which kind were stepped over.
    const std::map<std::uint8_t, std::uint64_t>& skipped() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A packet's name in CARLA's source, or "unknown packet N".
std::string carla_packet_name(std::uint8_t id);

}  // namespace reprise::exchange
