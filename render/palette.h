#pragma once

#include <array>
#include <cstdint>

namespace reprise::render {

using Rgb = std::array<std::uint8_t, 3>;

/// Colours of CARLA 0.9.14's tags, most of them those of CityScapes. Index: world::SemanticClass.
inline constexpr std::array<Rgb, 29> cityscapes{{
    {0, 0, 0},        // unlabeled
    {128, 64, 128},   // road
    {244, 35, 232},   // sidewalk
    {70, 70, 70},     // building
    {102, 102, 156},  // wall
    {190, 153, 153},  // fence
    {153, 153, 153},  // pole
    {250, 170, 30},   // traffic light
    {220, 220, 0},    // traffic sign
    {107, 142, 35},   // vegetation
    {152, 251, 152},  // terrain
    {70, 130, 180},   // sky
    {220, 20, 60},    // pedestrian
    {255, 0, 0},      // rider
    {0, 0, 142},      // car
    {0, 0, 70},       // truck
    {0, 60, 100},     // bus
    {0, 80, 100},     // train
    {0, 0, 230},      // motorcycle
    {119, 11, 32},    // bicycle
    {110, 190, 160},  // static
    {170, 120, 50},   // dynamic
    {55, 90, 80},     // other
    {45, 60, 150},    // water
    {157, 234, 50},   // road line
    {81, 0, 81},      // ground
    {150, 100, 100},  // bridge
    {230, 150, 140},  // rail track
    {180, 165, 180},  // guard rail
}};

/// What each of these is among the twelve classes of CARLA's paper, see in_paper_classes().
inline constexpr std::array<std::uint8_t, 29> paper_classes{
    0,   // unlabeled
    7,   // road
    8,   // sidewalk
    1,   // building
    11,  // wall
    2,   // fence
    5,   // pole
    12,  // traffic light
    12,  // traffic sign
    9,   // vegetation
    9,   // terrain
    0,   // sky
    4,   // pedestrian
    4,   // rider
    10,  // car
    10,  // truck
    10,  // bus
    10,  // train
    10,  // motorcycle
    10,  // bicycle
    3,   // static
    3,   // dynamic
    3,   // other
    3,   // water
    6,   // road line
    3,   // ground
    3,   // bridge
    3,   // rail track
    2,   // guard rail
};

}  // namespace reprise::render
