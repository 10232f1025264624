#include "world/models/doors.h"

#include <algorithm>
#include <numbers>

namespace reprise::world {

namespace {

constexpr double thickness = 0.08;  // [m]
constexpr double sill = 0.28;       // [m] above the ground
constexpr double front_length = 1.05;
constexpr double rear_length = 0.90;

}  // namespace

bool has_door(const VehicleModel& model, std::uint8_t door) {
    if (is_two_wheeler(model.body) || model.body == BodyStyle::bus || door >= door_count)
        return false;
    const bool behind = door >= 2;
    switch (model.body) {
        case BodyStyle::lorry:
        case BodyStyle::van:
        case BodyStyle::pickup:
        case BodyStyle::coupe:
        case BodyStyle::minibus:
            return !behind;
        default:
            return true;
    }
}

DoorLeaf door_leaf(const VehicleModel& model,
                   const Eigen::Isometry3d& pose_vehicle,
                   std::uint8_t door,
                   double angle) {
    const bool behind = door >= 2;
    const double side = door % 2 == 0 ? 1 : -1;
    const double length = behind ? rear_length : front_length;
    // The front wheels' housings end some 0.45 m behind their axle; a lorry's cab is ahead of it.
    const bool cab = model.body == BodyStyle::lorry;
    const double first = cab ? model.wheelbase + 0.9 : model.wheelbase - 0.45;
    const double hinge = first - (behind ? front_length + 0.03 : 0);
    const double top = std::min(model.height - 0.08, sill + 1.15);
    // Shut it points backwards along the side, and swings outwards.
    const Eigen::Isometry3d at_hinge =
        pose_vehicle * Eigen::Translation3d(hinge, side * (model.width / 2 - thickness / 2), 0);
    const double yaw = side * (std::numbers::pi - angle);
    DoorLeaf leaf{at_hinge, {length / 2, thickness / 2, (top - sill) / 2}};
    leaf.pose = at_hinge * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::Translation3d(length / 2, 0, (top + sill) / 2);
    return leaf;
}

}  // namespace reprise::world
