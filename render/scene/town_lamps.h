#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "render/shapes/buildings/building_plan.h"
#include "world/town_generated.h"

namespace reprise::render {

/// Where a town's own lights are, in the scene's frame.
struct TownLamps {
    struct StreetLight {
        Eigen::Vector3f position;  ///< just below the lamp
        bool lantern;              ///< of a park: shines all around, not down alone
    };

    /// The main lamps of a signal head.
    struct Head {
        Eigen::Vector3f top;     ///< of the housing's face
        Eigen::Vector3f facing;  ///< unit vector to those who look at it
        float height;            ///< [m] of the housing
        std::uint32_t signal;    ///< index in Town.signals
        bool for_walkers;
    };

    struct ShopWindow {
        Eigen::Vector3f position;
        Eigen::Vector3f facing;
        float area;  ///< [m2]
        float fate;  ///< see room_light
    };

    TownLamps() = default;
    TownLamps(const world::TownT& town, const Facades& facades, const Eigen::Vector3d& origin);

    std::vector<StreetLight> street_lights;
    std::vector<Head> heads;
    std::vector<ShopWindow> shop_windows;
};

}  // namespace reprise::render
