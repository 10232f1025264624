#pragma once

#include <string>

#include "replay/recording.h"
#include "scripting/scenario.h"
#include "traffic/town_reader.h"

namespace reprise::bench {

/// scenarios/free_drive.lua in Town 1 with this many background cars, without end.
inline replay::Recording free_drive(unsigned cars) {
    const std::string source = REPRISE_SOURCE;
    replay::Recording recording;
    recording.episode =
        scripting::load_episode(source + "/scenarios/free_drive.lua", {{}, 7, 36000.0, {}});
    recording.episode.cars = cars;
    traffic::Network network =
        traffic::load_network(source + "/scenarios/towns/town1/town1.net.xml");
    recording.town = traffic::read_town(network);
    recording.network = std::move(network.xml);
    return recording;
}

}  // namespace reprise::bench
