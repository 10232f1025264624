#pragma once

#include <string>

#include "replay/recording.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"

namespace reprise::bench {

/// A scenario in Town 1, without end.
inline replay::Recording in_town1(const std::string& scenario) {
    const std::string source = REPRISE_SOURCE;
    replay::Recording recording;
    recording.episode = scripting::load_episode(source + "/" + scenario, {{}, 7, 36000.0, {}});
    traffic::Network network =
        traffic::load_network(source + "/scenarios/towns/town1/town1.net.xml");
    recording.town = traffic::read_town(network);
    recording.network = std::move(network.xml);
    return recording;
}

/// scenarios/free_drive.lua with this many background cars.
inline replay::Recording free_drive(unsigned cars) {
    replay::Recording recording = in_town1("scenarios/free_drive.lua");
    recording.episode.cars = cars;
    return recording;
}

/// A car among 100 cars and 100 walkers.
inline replay::Recording crowd() {
    return in_town1("tests/bench/crowd.lua");
}

}  // namespace reprise::bench
