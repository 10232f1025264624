#include "exchange/carla/carla_packet_kinds.h"

#include <array>

#include <fmt/format.h>

namespace reprise::exchange {

namespace {

constexpr std::array<const char*, 24> packet_names{
    "FrameStart",       "FrameEnd",      "EventAdd",          "EventDel",
    "EventParent",      "Collision",     "Position",          "State",
    "AnimVehicle",      "AnimWalker",    "VehicleLight",      "SceneLight",
    "Kinematics",       "BoundingBox",   "PlatformTime",      "PhysicsControl",
    "TrafficLightTime", "TriggerVolume", "FrameCounter",      "WalkerBones",
    "VisualTime",       "VehicleDoor",   "AnimVehicleWheels", "AnimBiker"};

}  // namespace

bool is_known_packet(std::uint8_t kind) {
    return kind < packet_names.size();
}

std::string carla_packet_name(std::uint8_t kind) {
    return is_known_packet(kind) ? packet_names[kind] : fmt::format("unknown packet {}", kind);
}

}  // namespace reprise::exchange
