#include "traffic/fleet.h"

#include <array>
#include <fmt/format.h>

#include "world/catalogue.h"

namespace reprise::traffic {

namespace {

/// What a driver of such a car does, by body style. Accelerations are those of everyday driving
/// (SUMO's own defaults for its classes), not what the machine could do.
struct Manner {
    double share;         ///< of the background demand
    double acceleration;  ///< [m/s^2]
    double deceleration;  ///< [m/s^2] comfortable
    double emergency;     ///< [m/s^2]
    double top_speed;     ///< [m/s]
    double gap;           ///< [m] to the car in front when standing
};

constexpr std::array<Manner, 6> manners{{
    {0.30, 2.6, 4.5, 9.0, 55, 2.5},   // hatchback
    {0.32, 2.6, 4.5, 9.0, 55, 2.5},   // sedan
    {0.22, 2.4, 4.5, 9.0, 52, 2.5},   // suv
    {0.10, 2.0, 4.2, 8.0, 45, 2.5},   // van
    {0.03, 1.2, 4.0, 7.0, 25, 3.0},   // lorry
    {0.03, 1.2, 4.0, 7.0, 27.8, 3.0}  // bus
}};

const Manner& manner_of(const world::VehicleModel& model) {
    return manners[static_cast<std::size_t>(model.body)];
}

std::string type_xml(const std::string& id,
                     const world::VehicleModel& model,
                     const char* vehicle_class,
                     const char* moods) {
    const Manner& manner = manner_of(model);
    // lcOpposite 0: nobody overtakes through the oncoming lane, which networks with <neigh> invite.
    return fmt::format(
        R"(<vType id="{}" vClass="{}" length="{:.2f}" width="{:.2f}" height="{:.2f}" minGap="{:.1f}")"
        R"( accel="{:.1f}" decel="{:.1f}" emergencyDecel="{:.1f}" maxSpeed="{:.1f}" tau="1.0")"
        R"( carFollowModel="Krauss" laneChangeModel="LC2013" lcOpposite="0" {}/>)"
        "\n",
        id,
        vehicle_class,
        model.length,
        model.width,
        model.height,
        manner.gap,
        manner.acceleration,
        manner.deceleration,
        manner.emergency,
        manner.top_speed,
        moods);
}

}  // namespace

std::string vehicle_types_xml() {
    constexpr const char* moody = "sigma='0.5' speedFactor='normc(1.0,0.1,0.7,1.2)'";
    constexpr const char* even = "sigma='0' speedFactor='1' speedDev='0'";
    std::string xml = "<additional>\n";
    std::uint16_t index = 0;
    for (const world::VehicleModel& model : world::vehicle_models()) {
        xml += type_xml(demand_type(index), model, model.sumo_class, moody);
        xml += type_xml(scripted_type(index), model, "passenger", even);
        ++index;
    }
    return xml + "</additional>\n";
}

std::string demand_type(std::uint16_t model) {
    return fmt::format("d{}", model);
}

std::string scripted_type(std::uint16_t model) {
    return fmt::format("s{}", model);
}

ClassSet model_class(std::uint16_t model) {
    return class_bit(world::vehicle_models()[model].sumo_class);
}

std::uint16_t demand_model(double drawn) {
    const auto models = world::vehicle_models();
    double total = 0;
    for (const world::VehicleModel& model : models)
        total += manner_of(model).share;
    double left = drawn * total;
    for (std::uint16_t i = 0; i < models.size(); ++i) {
        left -= manner_of(models[i]).share;
        if (left < 0)
            return i;
    }
    return 0;
}

double origin_to_front(std::uint16_t model) {
    const world::VehicleModel& car = world::vehicle_models()[model];
    return car.length - car.rear_overhang;
}

}  // namespace reprise::traffic
