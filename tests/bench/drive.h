#pragma once

#include <string>

#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/recording.h"

namespace reprise::bench {

/// A scenario in Town 1, without end.
inline world::Recording in_town1(const std::string& scenario) {
    const std::string source = REPRISE_SOURCE;
    world::Recording recording;
    recording.episode = scripting::load_episode(source + "/" + scenario, {{}, 7, 36000.0, {}});
    towns::Network network = towns::load_network(source + "/scenarios/towns/town1/town1.net.xml");
    recording.town = towns::read_town(network);
    recording.network = std::move(network.xml);
    return recording;
}

/// scenarios/free_drive.lua with this many background cars.
inline world::Recording free_drive(unsigned cars) {
    world::Recording recording = in_town1("scenarios/free_drive.lua");
    recording.episode.cars = cars;
    return recording;
}

/// A car among 100 cars and 100 walkers.
inline world::Recording crowd() {
    return in_town1("tests/bench/crowd.lua");
}

}  // namespace reprise::bench
