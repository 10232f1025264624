#pragma once

#include <cstdint>
#include <string>

namespace reprise::exchange {

/// Kinds of packets, as CARLA numbers them; those from 18 on are not read.
enum CarlaPacket : std::uint8_t {
    frame_start,
    frame_end,
    event_add,
    event_del,
    event_parent,
    collision,
    position,
    state,
    anim_vehicle,
    anim_walker,
    vehicle_light,
    scene_light,
    kinematics,
    bounding_box,
    platform_time,
    physics_control,
    traffic_light_time,
    trigger_volume
};

/// Has CARLA's source a name for this kind?
bool is_known_packet(std::uint8_t kind);

/// A packet's name in CARLA's source, or "unknown packet N".
std::string carla_packet_name(std::uint8_t kind);

}  // namespace reprise::exchange
