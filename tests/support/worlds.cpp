#include "tests/support/worlds.h"

#include <cmath>
#include <string>

#include "world/weather/weather.h"

namespace reprise::test {

namespace {

constexpr double lane_width = 3.5;
constexpr double sidewalk_width = 2.5;

world::LaneT straight_lane(const std::string& edge, int index, double length, double y, bool east) {
    world::LaneT lane;
    lane.edge = edge;
    lane.name = edge + "_" + std::to_string(index);
    lane.kind = index == 0 ? world::LaneKind::sidewalk : world::LaneKind::driving;
    lane.index = static_cast<std::uint8_t>(index);
    const world::Vec3 west_end(0, y, 0);
    const world::Vec3 east_end(length, y, 0);
    lane.centre = east ? std::vector{west_end, east_end} : std::vector{east_end, west_end};
    lane.width = index == 0 ? sidewalk_width : lane_width;
    lane.length = length;
    lane.sumo_length = length;
    lane.speed_limit = 13.89;
    lane.left = lane.right = lane.opposite = lane.junction = world::none;
    return lane;
}

}  // namespace

world::TownT straight_road(double length, int lanes) {
    world::TownT town;
    town.name = "straight_road";
    for (const bool east : {true, false}) {
        const std::string edge = east ? "east" : "west";
        const double side = east ? -1 : 1;
        const auto first = static_cast<std::uint32_t>(town.lanes.size());
        for (int index = 0; index <= lanes; ++index) {
            const double from_axis = index == 0 ? lanes * lane_width + sidewalk_width / 2
                                                : (lanes - index + 0.5) * lane_width;
            town.lanes.push_back(straight_lane(edge, index, length, side * from_axis, east));
        }
        for (int index = 1; index <= lanes; ++index) {
            world::LaneT& lane = town.lanes[first + static_cast<std::uint32_t>(index)];
            if (index > 1)
                lane.right = first + static_cast<std::uint32_t>(index) - 1;
            if (index < lanes)
                lane.left = first + static_cast<std::uint32_t>(index) + 1;
        }
    }
    const auto leftmost_east = static_cast<std::uint32_t>(lanes);
    const auto leftmost_west = static_cast<std::uint32_t>(2 * lanes + 1);
    town.lanes[leftmost_east].opposite = leftmost_west;
    town.lanes[leftmost_west].opposite = leftmost_east;
    const double half = lanes * lane_width + sidewalk_width;
    town.low = world::Vec3(0, -half, 0);
    town.high = world::Vec3(length, half, 0);
    return town;
}

world::TownT straight_road_with_signal(double length) {
    world::TownT town = straight_road(length);
    world::SignalT signal;
    signal.program = "light";
    signal.position = town.lanes[1].centre.back();
    signal.lane = 1;
    town.signals.push_back(signal);
    town.lanes[1].links.emplace_back(
        world::none, world::none, 0, world::Turn::straight, false, std::uint16_t{0});
    return town;
}

world::EpisodeT episode(const char* lua_source) {
    world::EpisodeT episode;
    episode.name = "test";
    episode.scenario_path = "test.lua";
    episode.scenario = lua_source;
    episode.town = "straight_road";
    episode.seed = 7;
    episode.step_ns = 50'000'000;
    episode.substeps = 10;
    episode.max_ticks = 1200;
    episode.road_friction = 1;
    episode.weather = world::weather_presets().front().weather;
    episode.weather_name = world::weather_presets().front().name;
    return episode;
}

world::CarState car_at(std::uint32_t id, double x, double y, double yaw, double speed) {
    return {world::Vec3(x, y, 0),
            static_cast<float>(yaw),
            0,
            static_cast<float>(speed),
            0,
            id,
            world::none,
            0,
            0,
            0};
}

world::VehicleState vehicle_at(std::uint32_t id, double x, double y, double yaw, double speed) {
    const world::Quat orientation(std::cos(yaw / 2), 0, 0, std::sin(yaw / 2));
    const world::Vec3 velocity(speed * std::cos(yaw), speed * std::sin(yaw), 0);
    const world::Vec3 zero(0, 0, 0);
    return {world::Vec3(x, y, 0), orientation, velocity, zero, zero, 0, 0, id, 0, 0, 0, 0, 0, 0};
}

world::SealedTick tick_with(std::vector<world::VehicleState> vehicles,
                            std::vector<world::CarState> cars,
                            std::vector<world::SignalColor> signals,
                            std::uint64_t index) {
    world::TickDraft draft;
    draft.tick.index = index;
    draft.tick.vehicles = std::move(vehicles);
    draft.tick.signals = std::move(signals);
    draft.tick.road_friction = 1;
    draft.traffic.cars = std::move(cars);
    return world::seal(draft, {});
}

}  // namespace reprise::test
