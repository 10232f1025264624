#include "cli/dataset/nuscenes_names.h"

#include <array>
#include <cctype>
#include <string_view>

#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"

namespace reprise::cli {

namespace {

enum Taxon : std::size_t {
    adult,
    child,
    worker,
    barrier,
    debris,
    traffic_cone,
    bicycle,
    bus,
    car,
    ambulance,
    police,
    motorcycle,
    truck
};

constexpr std::array category_rows{
    NuscenesName{"human.pedestrian.adult", "Somebody on foot"},
    NuscenesName{"human.pedestrian.child", "A child on foot"},
    NuscenesName{"human.pedestrian.construction_worker", "Somebody in a reflecting vest"},
    NuscenesName{"movable_object.barrier", "A barrier of concrete or plastic"},
    NuscenesName{"movable_object.debris", "Boxes, pallets, planks, tyres and warning triangles"},
    NuscenesName{"movable_object.trafficcone", "A traffic cone"},
    NuscenesName{"vehicle.bicycle", "A bicycle and who rides it"},
    NuscenesName{"vehicle.bus.rigid", "Buses and minibuses"},
    NuscenesName{"vehicle.car", "Cars, vans and taxis"},
    NuscenesName{"vehicle.emergency.ambulance", "An ambulance"},
    NuscenesName{"vehicle.emergency.police", "A car of the police"},
    NuscenesName{"vehicle.motorcycle", "A motorcycle and who rides it"},
    NuscenesName{"vehicle.truck", "Lorries and pickups"},
};

enum Doing : std::size_t { with_rider, walking, lying, standing, moving, parked_vehicle, stopped };

constexpr std::array attribute_rows{
    NuscenesName{"cycle.with_rider", "Somebody rides it"},
    NuscenesName{"pedestrian.moving", "Faster than 0.2 m/s"},
    NuscenesName{"pedestrian.sitting_lying_down", "Was hit and lies on the ground"},
    NuscenesName{"pedestrian.standing", "Stands"},
    NuscenesName{"vehicle.moving", "Faster than 0.2 m/s"},
    NuscenesName{"vehicle.parked", "Stands, and nobody drives it"},
    NuscenesName{"vehicle.stopped", "Stands, and somebody drives it"},
};

constexpr std::array visibility_rows{
    NuscenesName{"v0-40", "Cameras see 0 to 40 % of it"},
    NuscenesName{"v40-60", "Cameras see 40 to 60 % of it"},
    NuscenesName{"v60-80", "Cameras see 60 to 80 % of it"},
    NuscenesName{"v80-100", "Cameras see 80 to 100 % of it"},
};

Taxon taxon_of(const world::VehicleModel& model) {
    using world::BodyStyle;
    if (model.livery == world::Livery::police)
        return police;
    if (model.livery == world::Livery::ambulance)
        return ambulance;
    switch (model.body) {
        case BodyStyle::motorcycle:
            return motorcycle;
        case BodyStyle::bicycle:
            return bicycle;
        case BodyStyle::lorry:
        case BodyStyle::pickup:
            return truck;
        case BodyStyle::bus:
        case BodyStyle::minibus:
            return bus;
        default:
            return car;
    }
}

std::optional<std::size_t> taxon_of(const world::PropModel& model) {
    const std::string_view name = model.name;
    if (name == "cone")
        return traffic_cone;
    if (name.ends_with("barrier"))
        return barrier;
    return name == "sign_post" ? std::nullopt : std::optional<std::size_t>(debris);
}

const world::VehicleModel* vehicle_model(const world::TickView& tick, std::uint32_t actor) {
    if (const world::VehicleState* vehicle = world::find(tick.vehicles(), actor))
        return &world::vehicle_models()[vehicle->model()];
    if (const world::CarState* car = world::find(tick.cars(), actor))
        return &world::vehicle_models()[car->model()];
    return nullptr;
}

/// [m/s] of a vehicle, with mass or without.
double speed_of(const world::TickView& tick, std::uint32_t actor) {
    if (const world::VehicleState* vehicle = world::find(tick.vehicles(), actor))
        return world::to_eigen(vehicle->velocity()).norm();
    return std::abs(static_cast<double>(world::find(tick.cars(), actor)->speed()));
}

}  // namespace

std::span<const NuscenesName> nuscenes_categories() {
    return category_rows;
}

std::span<const NuscenesName> nuscenes_attributes() {
    return attribute_rows;
}

std::span<const NuscenesName> nuscenes_visibilities() {
    return visibility_rows;
}

std::string nuscenes_channel(const world::SensorSpec& sensor, bool first_lidar) {
    const std::string kind = world::is_camera(sensor.kind)             ? "CAM_"
                             : sensor.kind == world::SensorKind::radar ? "RADAR_"
                                                                       : "LIDAR_";
    std::string name = sensor.name;
    for (char& letter : name)
        letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    if (name.starts_with(kind))
        return name;
    return first_lidar ? "LIDAR_TOP" : kind + name;
}

std::optional<std::size_t> nuscenes_category(const world::TickView& tick, std::uint32_t actor) {
    if (const world::VehicleModel* model = vehicle_model(tick, actor))
        return taxon_of(*model);
    if (const world::PropState* prop = world::find(tick.props(), actor))
        return taxon_of(world::prop_models()[prop->model()]);
    const world::WalkerState* walker = world::find(tick.walkers(), actor);
    if (walker == nullptr)
        return std::nullopt;
    const world::WalkerModel& model = world::walker_models()[walker->model()];
    if (model.age == world::Age::child)
        return child;
    return model.clothing == world::Clothing::workwear ? worker : adult;
}

std::optional<std::size_t> nuscenes_attribute(const world::TickView& tick,
                                              std::uint32_t actor,
                                              bool parked) {
    constexpr double stands = 0.2;  // [m/s]
    if (const world::VehicleModel* model = vehicle_model(tick, actor)) {
        if (world::is_two_wheeler(model->body))
            return with_rider;
        return speed_of(tick, actor) > stands ? moving : parked ? parked_vehicle : stopped;
    }
    const world::WalkerState* walker = world::find(tick.walkers(), actor);
    if (walker == nullptr)
        return std::nullopt;
    if (walker->down())
        return lying;
    return static_cast<double>(walker->speed()) > stands ? walking : standing;
}

std::size_t nuscenes_category(const world::VehicleModel& parked) {
    return taxon_of(parked);
}

std::optional<std::size_t> nuscenes_attribute(const world::VehicleModel& parked) {
    return world::is_two_wheeler(parked.body) ? std::nullopt
                                              : std::optional<std::size_t>(parked_vehicle);
}

std::string nuscenes_visibility(double share) {
    return share < 0.4 ? "1" : share < 0.6 ? "2" : share < 0.8 ? "3" : "4";
}

}  // namespace reprise::cli
