#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "world/tick_generated.h"

namespace reprise::world {

/// One of world/external/sensor_attributes.h.
struct AttributeValue {
    std::string name;
    double value = 0;

    bool operator==(const AttributeValue& other) const = default;
};

/// What to see, from where. Camera frame: optical, x right, y down, z ahead.
struct SensorSpec {
    std::string name;
    SensorKind kind = SensorKind::rgb;
    int width = 800;                           ///< [px]
    int height = 600;                          ///< [px]
    double fov = std::numbers::pi / 2;         ///< [rad] horizontal
    std::uint32_t actor = 0;                   ///< mounted on; 0: the world
    Eigen::Vector3d position{1.0, 0.0, 1.4};   ///< [m] in the actor's frame
    double yaw = 0;                            ///< [rad] left positive
    double pitch = 0;                          ///< [rad] up positive
    double roll = 0;                           ///< [rad] right side down positive
    std::vector<AttributeValue> attributes{};  ///< what is not said is as usual
    double step = 0.05;                        ///< [s] of a tick
    std::uint32_t every = 1;                   ///< [ticks] from frame to frame, which LiDARs sweep
};

using SensorRig = std::vector<SensorSpec>;

enum class PixelType : std::uint8_t { u8, u16, f32 };

/// A change of brightness that a pixel of an event camera noticed.
struct PixelEvent {
    std::int64_t time_ns = 0;  ///< of the run
    std::uint16_t x = 0;
    std::uint16_t y = 0;
    bool rising = false;

    bool operator==(const PixelEvent& other) const = default;
};

/// What was seen: rows from the top, pixels from the left, channels interleaved.
///   rgb       u8, 3 channels: R, G, B (sRGB)
///   depth     f32, 1 channel: [m] along the optical axis; infinity where there is only sky
///   semantic  u8, 1 channel: SemanticClass
///   instance  u16, 1 channel: what thing it is, see world/external/instance_id.h
///   flow      f32, 2 channels: [px] to the right and down, by which what is seen in the pixel has
///             moved in the picture since the last tick, or will until the next one (attribute
///             forward); quiet NaN where it is not known
///   normals   f32, 3 channels: unit vector out of the surface, in the camera's frame; zero where
///             there is only sky
///   dvs       u8, 2 channels: how many events of rising and of falling brightness since the last
///             tick, 255 at most; `events` has each of them
/// The depth of a fisheye is the distance from the camera. What a lens does not see at all (its
/// picture ends before the picture's corners) is black, of class unlabeled, and without depth.
struct SensorFrame {
    std::string name;
    SensorKind kind = SensorKind::rgb;
    std::uint64_t tick = 0;
    int width = 0;
    int height = 0;
    int channels = 0;
    PixelType type = PixelType::u8;
    std::vector<std::uint8_t> data;
    std::vector<PixelEvent> events{};  ///< of dvs: by time, then by rows
};

/// Those that make pictures.
inline constexpr bool is_camera(SensorKind kind) {
    return kind <= SensorKind::dvs;
}

/// What measures by rays: frames are rows of numbers, see world/external/point_fields.h.
inline constexpr bool is_ranging(SensorKind kind) {
    return kind == SensorKind::lidar || kind == SensorKind::semantic_lidar ||
           kind == SensorKind::radar || kind == SensorKind::obstacle;
}

/// What follows from a tick and the one before it without any ray: see render/readings.
inline constexpr bool is_reading(SensorKind kind) {
    return kind >= SensorKind::gnss && kind <= SensorKind::lane_invasion;
}

/// Of these, what says what happened, in whatever tick that was.
inline constexpr bool tells_what_happens(SensorKind kind) {
    return kind == SensorKind::collision || kind == SensorKind::lane_invasion;
}

/// All that can be asked for by the names that users say, then those of cameras alone.
std::vector<std::string> sensor_kinds();
std::optional<SensorKind> find_sensor_kind(std::string_view name);

/// Kinds by the names that users say.
std::vector<std::string> camera_kinds();
std::optional<SensorKind> find_camera_kind(std::string_view name);

/// Of the interleaved channels of a camera's frame, and what each of them is.
int channels(SensorKind kind);
PixelType pixel_type(SensorKind kind);

/// [bytes] of one channel.
std::size_t bytes_of(PixelType type);

/// CARLA 0.9.14's tags (CityScapes order); colours in render/palette.h.
enum class SemanticClass : std::uint8_t {
    unlabeled = 0,
    road = 1,
    sidewalk = 2,
    building = 3,
    wall = 4,
    fence = 5,
    pole = 6,
    traffic_light = 7,
    traffic_sign = 8,
    vegetation = 9,
    terrain = 10,
    sky = 11,
    pedestrian = 12,
    rider = 13,
    car = 14,
    truck = 15,
    bus = 16,
    motorcycle = 18,
    bicycle = 19,
    static_object = 20,   ///< benches, bus stops, hydrants
    dynamic_object = 21,  ///< what could be carried away, such as bins, and props
    water = 23,
    road_line = 24,
    ground = 25,  ///< squares, paths, car parks
    bridge = 26,
    guard_rail = 28
};

}  // namespace reprise::world
