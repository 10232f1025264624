#include "traffic/cars/fleet.h"

#include <array>

#include <fmt/format.h>

#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

namespace {

/// What a driver of such a vehicle does. Accelerations are those of everyday driving (SUMO's own
/// defaults for its classes), not what the machine could do.
struct Manner {
    double share;         ///< of the background demand
    double acceleration;  ///< [m/s^2]
    double deceleration;  ///< [m/s^2] comfortable
    double emergency;     ///< [m/s^2]
    double top_speed;     ///< [m/s]
    double gap;           ///< [m] to the car in front when standing
};

/// [i] of vehicle_models()[i].
constexpr std::array<Manner, 16> manners{{
    {0.225, 2.6, 4.5, 9.0, 55, 2.5},    // sedan
    {0.225, 2.6, 4.5, 9.0, 55, 2.5},    // hatchback
    {0.170, 2.4, 4.5, 9.0, 52, 2.5},    // suv
    {0.075, 2.0, 4.2, 8.0, 45, 2.5},    // van
    {0.025, 1.2, 4.0, 7.0, 25, 3.0},    // lorry
    {0.022, 1.2, 4.0, 7.0, 27.8, 3.0},  // bus
    {0.070, 2.4, 4.5, 9.0, 45, 2.5},    // city_car
    {0.080, 2.6, 4.5, 9.0, 55, 2.5},    // wagon
    {0.020, 2.9, 4.5, 9.0, 60, 2.5},    // coupe
    {0.020, 2.2, 4.3, 8.5, 48, 2.5},    // pickup
    {0.025, 2.6, 4.5, 9.0, 55, 2.5},    // taxi
    {0.008, 2.6, 4.5, 9.0, 55, 2.5},    // police
    {0.004, 2.0, 4.2, 8.0, 42, 2.5},    // ambulance
    {0.006, 1.6, 4.0, 8.0, 36, 3.0},    // minibus
    {0.020, 2.9, 4.5, 9.0, 50, 2.5},    // motorcycle
    {0.005, 1.2, 3.0, 6.0, 5.6, 1.5},   // bicycle: few, because nobody overtakes on a single lane
}};

const Manner& manner_of(std::uint16_t model) {
    return manners.at(model);
}

std::string type_xml(const std::string& id,
                     std::uint16_t index,
                     const char* vehicle_class,
                     const char* moods) {
    const world::VehicleModel& model = world::vehicle_models()[index];
    const Manner& manner = manner_of(index);
    // lcOpposite 0: nobody overtakes through the oncoming lane, which networks with <neigh> invite.
    return fmt::format(
        R"(<vType id="{}" vClass="{}" length="{:.2f}" width="{:.2f}" height="{:.2f}" minGap="{:.1f}")"
        R"( accel="{:.1f}" decel="{:.1f}" emergencyDecel="{:.1f}" maxSpeed="{:.1f}" tau="1.0")"
        R"( carFollowModel="Krauss" laneChangeModel="LC2013" lcOpposite="0" maxSpeedLat="{}" {}/>)"
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
        usual_aside,
        moods);
}

}  // namespace

std::string vehicle_types_xml() {
    constexpr const char* moody = "sigma='0.5' speedFactor='normc(1.0,0.1,0.7,1.2)'";
    constexpr const char* even = "sigma='0' speedFactor='1' speedDev='0'";
    std::string xml = "<additional>\n";
    for (std::uint16_t i = 0; i < manners.size(); ++i) {
        const char* vehicle_class = world::vehicle_models()[i].sumo_class;
        xml += type_xml(demand_type(i), i, vehicle_class, moody);
        xml += type_xml(scripted_type(i), i, "passenger", even);
    }
    xml += fmt::format(
        R"(<vType id="{}" vClass="passenger" length="{}" width="1.8" minGap="0" sigma="0"/>)"
        "\n",
        stand_in_type(),
        stand_in_length);
    return xml + "</additional>\n";
}

std::string demand_type(std::uint16_t model) {
    return fmt::format("d{}", model);
}

std::string stand_in_type() {
    return "stand-in";
}

std::string scripted_type(std::uint16_t model) {
    return fmt::format("s{}", model);
}

double comfortable_braking(std::uint16_t model) {
    return manner_of(model).deceleration;
}

double emergency_braking(std::uint16_t model) {
    return manner_of(model).emergency;
}

world::ClassSet model_class(std::uint16_t model) {
    return world::class_bit(world::vehicle_models()[model].sumo_class);
}

std::uint16_t demand_model(double drawn, world::ClassSet at_home) {
    const auto share = [&](std::uint16_t model) {
        return (model_class(model) & at_home) != 0 ? manner_of(model).share : 0;
    };
    double total = 0;
    for (std::uint16_t i = 0; i < manners.size(); ++i)
        total += share(i);
    double left = drawn * total;
    for (std::uint16_t i = 0; i < manners.size(); ++i) {
        left -= share(i);
        if (left < 0)
            return i;
    }
    return 0;
}

double top_speed(std::uint16_t model) {
    return manner_of(model).top_speed;
}

double origin_to_front(std::uint16_t model) {
    const world::VehicleModel& car = world::vehicle_models()[model];
    return car.length - car.rear_overhang;
}

}  // namespace reprise::traffic
