#pragma once

#include <cstdint>

#include "world/external/sensor.h"

namespace reprise::render {

/// What a triangle is made of. Finer detail - windows, lamps, rims - is decided at the hit from its
/// place on the surface, see *_look.cpp.
enum class Material : std::uint8_t {
    grass,  ///< tag: 0, or land_far_off
    asphalt,
    pavement,
    kerb,
    deck,  ///< sides and undersides of bridges
    marking,
    facade,    ///< tag: index in Town.buildings
    roof,      ///< tag: index in Town.buildings
    wall,      ///< of a building with a model; tag: index in Facades.walls
    building,  ///< its other parts; tag: see BuildingFinish
    prop,      ///< tag: see PropTag
    thing,     ///< of a scenario's prop; tag: its paint, 0xRRGGBB, or instance_paint
    plot,      ///< tag: index in Town.plots
    bark,
    leaf,  ///< tag: hash of the leaf
    pole,
    signal_case,
    signal_lamp,  ///< tag: 4 * index in Town.signals + SignalLamp
    car_body,     ///< paint, glass and lamps: tag is unused
    car_cargo,    ///< the box of a lorry
    car_under,    ///< black: chassis, wheel housings, mirrors' backs
    car_part,     ///< tag: CarPart
    wheel,
    of_instance,  ///< as Instance::material says: one of the following
    skin,
    eye,
    lips,
    hair,
    headgear,
    shirt,
    trousers,
    shoe,
    trim,  ///< vest, belt, tie, apron
    bag,
    umbrella
};

/// Tag of grass beyond the town: fields, hedges and woods are drawn on it.
inline constexpr std::uint32_t land_far_off = 1;

enum class SignalLamp : std::uint8_t { red, yellow, green, turn };

}  // namespace reprise::render
