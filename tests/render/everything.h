#pragma once

#include <algorithm>

#include "tests/render/frames.h"
#include "world/models/building_models.h"

/// A straight street with one of everything that stands in a town.
namespace reprise::test {

/// A building of a model, as large as its middle bounds; fronts look to -y of its own frame.
inline world::Building building_of(std::uint32_t index, double x, double y, double yaw) {
    const world::BuildingModel& model = world::building_models()[index];
    const int floors = (model.fewest_floors + model.most_floors) / 2;
    return {world::Vec3(x, y, 0),
            yaw,
            (model.shortest + model.longest) / 2,
            (model.shallowest + model.deepest) / 2,
            model.ground_floor + model.floor_height * (floors - 1) + 0.5,
            101 + 7 * index,
            index + 1};
}

/// All 40 models, every second one on the left of a road along x.
inline std::vector<world::Building> all_buildings() {
    std::vector<world::Building> buildings;
    std::array<double, 2> x{20, 20};
    for (std::uint32_t i = 0; i < world::building_models().size(); ++i) {
        const bool left = i % 2 == 0;
        world::Building building = building_of(i, 0, 0, left ? 0 : 3.14159265358979);
        const double y = 10 + building.width() / 2;
        x[i % 2] += building.length() / 2;
        building.mutable_centre() = world::Vec3(x[i % 2], left ? y : -y, 0);
        x[i % 2] += building.length() / 2 + 5;
        buildings.push_back(building);
    }
    return buildings;
}

inline std::vector<world::Tree> all_plants() {
    std::vector<world::Tree> plants;
    for (std::uint32_t kind = 1; kind <= 11; ++kind) {
        const bool bush = kind >= 9;
        const double height = bush ? 1.5 : 8 + kind % 3;
        const double slender = kind == 3 ? 0.14 : kind == 8 ? 0.24 : kind == 2 ? 0.24 : 0.4;
        plants.emplace_back(world::Vec3(12.0 + 7 * kind, 7.5, 0),
                            height,
                            height * (bush ? 0.6 : slender),
                            40 + kind,
                            static_cast<world::PlantKind>(kind));
    }
    return plants;
}

inline std::vector<world::Prop> all_props() {
    std::vector<world::Prop> props;
    const auto kinds = static_cast<int>(world::PropKind::table) + 1;
    for (int kind = 0; kind < kinds; ++kind)
        props.emplace_back(world::Vec3(16 + 4.5 * kind, -7.5, 0.0),
                           0.0,
                           0.0,
                           0.0,
                           0.0,
                           static_cast<std::uint32_t>(kind),
                           static_cast<std::uint16_t>(kind == 0 ? 50 : 0),
                           static_cast<world::PropKind>(kind),
                           std::uint8_t{0});
    return props;
}

inline world::PlotT plot(world::PlotKind kind, double left, double low, double right, double high) {
    world::PlotT plot;
    plot.kind = kind;
    plot.outline = {world::Vec3(left, low, 0),
                    world::Vec3(right, low, 0),
                    world::Vec3(right, high, 0),
                    world::Vec3(left, high, 0)};
    return plot;
}

}  // namespace reprise::test
