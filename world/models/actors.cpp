#include "world/models/actors.h"

#include "world/frames.h"

namespace reprise::world {

Extent extent_of(const VehicleModel& model) {
    return {
        -model.rear_overhang, model.length - model.rear_overhang, model.width / 2, model.height};
}

Extent extent_of(const WalkerModel& model) {
    const double half = model.shoulder_width / 2;
    return {-half, half, half, model.height};
}

Extent extent_of(const PropModel& model) {
    return {-model.length / 2, model.length / 2, model.width / 2, model.height};
}

std::optional<Extent> find_extent(const TickView& tick, std::uint32_t actor) {
    if (const VehicleState* vehicle = find(tick.vehicles(), actor))
        return extent_of(vehicle_models()[vehicle->model()]);
    if (const CarState* car = find(tick.cars(), actor))
        return extent_of(vehicle_models()[car->model()]);
    if (const WalkerState* walker = find(tick.walkers(), actor))
        return extent_of(walker_models()[walker->model()]);
    if (const PropState* prop = find(tick.props(), actor))
        return extent_of(prop_models()[prop->model()]);
    return std::nullopt;
}

std::optional<Eigen::Isometry3d> find_pose(const TickView& tick, std::uint32_t actor) {
    if (const VehicleState* vehicle = find(tick.vehicles(), actor))
        return pose(vehicle->position(), vehicle->orientation());
    if (const CarState* car = find(tick.cars(), actor))
        return pose(
            car->position(), static_cast<double>(car->yaw()), static_cast<double>(car->pitch()));
    if (const WalkerState* walker = find(tick.walkers(), actor))
        return pose(walker->position(), static_cast<double>(walker->yaw()), 0);
    if (const PropState* prop = find(tick.props(), actor))
        return pose(prop->position(), prop->orientation());
    return std::nullopt;
}

}  // namespace reprise::world
