#include "world/models/powertrain.h"

#include <algorithm>
#include <numbers>

namespace reprise::world {

namespace {

constexpr double rpm = 2 * std::numbers::pi / 60;

struct Gearbox {
    int gears;
    int direct;  ///< the gear of the top speed
    std::array<double, Powertrain::most_gears> ratios;
    double shift_time;  // [s] from one clutch to the next
};

constexpr Gearbox of_cars{8, 6, {4.71, 3.14, 2.11, 1.67, 1.29, 1.00, 0.84, 0.67}, 0.2};
constexpr Gearbox of_buses{6, 6, {3.36, 1.91, 1.42, 1.00, 0.72, 0.62}, 0.4};
constexpr Gearbox of_lorries{6, 6, {3.49, 1.86, 1.41, 1.00, 0.75, 0.65}, 0.4};
constexpr Gearbox of_motorcycles{6, 6, {2.846, 2.125, 1.632, 1.300, 1.091, 0.964}, 0.15};

struct Engine {
    double peak_rpm;
    double idle_rpm;
    bool diesel;
    const Gearbox* gearbox;
};

Engine engine_of(BodyStyle body) {
    switch (body) {
        case BodyStyle::hatchback:
        case BodyStyle::sedan:
        case BodyStyle::suv:
        case BodyStyle::wagon:
            return {5500, 750, false, &of_cars};
        case BodyStyle::coupe:
            return {6500, 800, false, &of_cars};
        case BodyStyle::van:
        case BodyStyle::pickup:
        case BodyStyle::minibus:
            return {3600, 800, true, &of_cars};
        case BodyStyle::lorry:
            return {2300, 650, true, &of_lorries};
        case BodyStyle::bus:
            return {2200, 600, true, &of_buses};
        case BodyStyle::motorcycle:
            return {9000, 1300, false, &of_motorcycles};
        case BodyStyle::bicycle:
            break;
    }
    return {};
}

}  // namespace

Powertrain powertrain(const VehicleModel& model, double top_speed) {
    Powertrain train;
    train.power = model.power;
    train.most_force = model.max_drive_force;
    const Engine engine = engine_of(model.body);
    if (engine.gearbox == nullptr)
        return train;
    const Gearbox& box = *engine.gearbox;
    train.gears = box.gears;
    train.peak_speed = engine.peak_rpm * rpm;
    train.idle_speed = engine.idle_rpm * rpm;
    // Near the largest torque, where a starting engine is held.
    train.launch_speed = 0.4 * train.peak_speed;
    train.limit_speed = (engine.diesel ? 1.08 : 1.12) * train.peak_speed;
    train.linear = engine.diesel ? 0.87 : 1;
    train.square = engine.diesel ? 1.13 : 1;
    train.shift_time = box.shift_time;
    const double direct = box.ratios[static_cast<std::size_t>(box.direct - 1)];
    const double final_drive = train.peak_speed / (direct * top_speed);
    for (std::size_t i = 0; i < static_cast<std::size_t>(box.gears); ++i)
        train.ratios[i] = box.ratios[i] * final_drive;
    return train;
}

double Powertrain::force(int gear, double speed) const {
    const double shaft = std::max(engine_speed(gear, speed), launch_speed);
    if (shaft > limit_speed)
        return 0;
    const double x = shaft / peak_speed;
    const double torque = power / peak_speed * (linear + x * (square - x));
    return std::min(most_force, torque * ratios[static_cast<std::size_t>(gear - 1)]);
}

double Powertrain::largest_force(double speed) const {
    if (gears == 0)
        return std::min(most_force, power / std::max(speed, 0.1));
    double most = 0;
    for (int gear = 1; gear <= gears; ++gear)
        most = std::max(most, force(gear, speed));
    return most;
}

}  // namespace reprise::world
