#pragma once

#include <cstdint>
#include <vector>

#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town_generated.h"

/// Small worlds for tests, built in code.
namespace reprise::test {

/// A straight road eastwards along y = 0 from x = 0, with `lanes` lanes of 3.5 m in each direction
/// (right-hand traffic: eastbound ones south of the axis) and a 2.5 m sidewalk on both sides.
/// Lanes: east_0 (sidewalk), east_1 ... east_N (1 is the rightmost), west_0 ... likewise.
/// Speed limit 13.89 m/s. No junction, no signal.
world::TownT straight_road(double length = 400, int lanes = 1);

/// As straight_road, with a signal facing the end of east_1 (Town.signals[0]).
world::TownT straight_road_with_signal(double length = 400);

/// seed 7, 50 ms ticks of 10 substeps, one minute, no background cars, dry road, clear noon.
world::EpisodeT episode(const char* lua_source = "");

/// A car standing or driving on the plane.
world::CarState car_at(std::uint32_t id, double x, double y, double yaw = 0, double speed = 0);

/// A sedan with mass, level on the plane z = 0.
world::VehicleState vehicle_at(
    std::uint32_t id, double x, double y, double yaw = 0, double speed = 0);

/// A sealed tick that holds these and nothing else.
world::SealedTick tick_with(std::vector<world::VehicleState> vehicles,
                            std::vector<world::CarState> cars = {},
                            std::vector<world::SignalColor> signals = {},
                            std::uint64_t index = 1);

}  // namespace reprise::test
