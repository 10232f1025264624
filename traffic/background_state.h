#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "traffic/background.h"
#include "traffic/car.h"
#include "traffic/mirrors.h"
#include "traffic/places.h"
#include "traffic/road_graph.h"
#include "traffic/sumo.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

inline constexpr double planned_route = 1500;  ///< [m] of route made at once

/// All that Background keeps. Its stages, in their order, lie in orders.cpp (commands), demand.cpp
/// (the number of cars), reading.cpp (what SUMO made of it) and background.cpp (the step).
struct Background::Sumo {
    Sumo(const world::EpisodeT& episode,
         const world::TownT& town,
         const world::LaneMap& lanes,
         std::string_view network);

    // orders.cpp: what the scenario says of cars that traffic owns.
    void carry_out(const world::TickView& last, world::TickDraft& next);
    void spawn(const world::CommandT& command, const world::TickView& last, world::TickDraft& next);
    void order(const world::CommandT& command, Car& car);
    void follow_orders();

    // demand.cpp: as many cars as the episode asks for, and a way ahead for each.
    void keep_number(const world::TickView& last, world::TickDraft& next);
    bool add_demand_car(const std::vector<Taken>& taken, bool first, world::TickDraft& next);
    void remove_leaving(const world::TickView& last, world::TickDraft& next);
    void keep_routes();

    // background.cpp
    void insert_into_sumo(Car& car, const Place& place, const std::string& type);
    void drop_arrived(world::TickDraft& next);
    void remove(std::size_t index, world::TickDraft& next);
    Car* find(std::uint32_t id);
    Car& add(Car car);
    std::uint32_t lane_index(std::string_view name) const;
    world::ClassSet classes_of(const Car& car) const;
    std::vector<Taken> taken_ground(const world::TickView& last,
                                    const world::TickDraft& next) const;

    // reading.cpp
    void read_cars();
    void read_car(Car& car);
    void read_signals(world::TickDraft& next);
    void write_cars(world::TickDraft& next) const;
    std::uint64_t digest() const;

    const world::EpisodeT& episode;
    const world::TownT& town;
    double step;  ///< [s]
    SumoProcess process;
    RoadGraph graph;
    Places places;
    world::ClassSet at_home;  ///< classes that most roads are open to
    Mirrors mirrors;
    std::unordered_map<std::string_view, std::uint32_t> lanes_by_name;  ///< looked up, never walked

    std::vector<bool> alone_on_edge;  ///< by lane: no other lane to change to

    struct Program {
        std::string name;
        std::size_t first = 0;  ///< in Town.signals
        std::size_t count = 0;
        std::string state;  ///< as last read
    };

    std::vector<Program> programs;
    std::vector<world::SignalColor> signals;

    std::uint64_t tick = 0;  ///< being made
    std::uint32_t next_id = world::first_background_id;
    std::uint64_t place_draws = 0;
    std::vector<Car> cars;  ///< sorted by id
};

/// Draws places until one is free, at most `tries` times; the longer it takes, the less room is
/// asked for.
struct PlaceSearch {
    std::uint64_t seed = 0;
    std::uint64_t tick = 0;
    world::Purpose purpose = world::Purpose::demand_place;
    std::uint64_t item = 0;  ///< of the first draw; advanced
    int tries = 0;
    double margin = 0;  ///< [m] wished
    double sight = 0;   ///< [m] wished
};

std::optional<Place> find_place(const Places& places,
                                double car_length,
                                world::ClassSet car,
                                std::span<const Taken> taken,
                                PlaceSearch& search);

/// A speed at which a car may stand up there without anybody braking hard. [m/s]
double entry_speed(const world::LaneT& lane, const Place& place, double room);

}  // namespace reprise::traffic
