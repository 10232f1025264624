#pragma once

#include "tests/render/frames.h"

/// A street with something of everything that pictures are made of.
namespace reprise::test {

inline world::TownT street() {
    world::TownT town = straight_road_with_signal(400);
    town.buildings = {
        {world::Vec3(60, -16, 0), 0.1, 18, 12, 14, 3, 0},
        {world::Vec3(75, 15, 0), -0.05, 25, 10, 9, 17, 0},
        {world::Vec3(140, 20, 0), 0.4, 20, 20, 30, 8, 0},
    };
    town.trees = {
        {world::Vec3(52, 8, 0), 7, 2.5, 5, world::PlantKind::any},
        {world::Vec3(66, -8.5, 0), 5, 1.8, 130, world::PlantKind::any},
        {world::Vec3(90, 8, 0), 9, 3, 77, world::PlantKind::any},
    };
    return town;
}

/// Vehicle 1 carries the cameras.
inline world::SealedTick street_tick() {
    world::TickDraft draft;
    draft.tick.index = 40;
    draft.tick.vehicles = {vehicle_at(1, 40, -1.75)};
    draft.tick.signals = {world::SignalColor::red};
    draft.traffic.cars = {car_at(10, 55, -1.75),
                          car_at(11, 60, 1.75, 3.14159),
                          car_at(12, 95, -1.70, 0.02),
                          car_at(13, 130, 1.75, 3.1)};
    draft.traffic.walkers = {
        {world::Vec3(50, -4.5, 0.15), 0, 1.2F, 0.3F, 20, 0, false, std::uint8_t{0}, 0U},
        {world::Vec3(58, 4.4, 0.15), 2, 1.4F, 1.9F, 20, 0, false, std::uint8_t{1}, 0U}};
    return world::seal(draft, {});
}

/// All kinds that there are, rgb, depth and semantic first, from the driver's place.
inline world::SensorRig street_rig(int width = 160, int height = 120) {
    world::SensorRig rig;
    for (const world::SensorKind kind : {world::SensorKind::rgb,
                                         world::SensorKind::depth,
                                         world::SensorKind::semantic,
                                         world::SensorKind::instance,
                                         world::SensorKind::normals,
                                         world::SensorKind::flow}) {
        world::SensorSpec& spec = rig.emplace_back(camera(kind, {1, 0, 1.4}));
        spec.actor = 1;
        spec.width = width;
        spec.height = height;
    }
    return rig;
}

struct NamedWeather {
    const char* name;
    world::Weather weather;
};

inline std::vector<NamedWeather> weathers() {
    // The sun 3 degrees below the horizon: lamps, lit windows and beams on a wet road.
    const world::Weather nightfall(
        -1.9F, -0.05F, 0.5F, 6, 1e-3F, 0.8F, 0.4F, 4, 0.35F, 3, 0, 0, 0, 0, 0);
    return {{"clear_noon", noon()}, {"hard_rain_sunset", rain()}, {"rainy_nightfall", nightfall}};
}

}  // namespace reprise::test
