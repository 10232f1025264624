#include "tests/kernel/whole_run.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/digest.h"

namespace reprise::test {

namespace {

world::Recording recording_of(const towns::Network& network,
                              const std::string& body,
                              unsigned cars,
                              double seconds) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("reprise_whole_run_" + std::to_string(getpid()) + ".lua");
    std::ofstream(path) << "return scenario 'test' { town = 'town1', seed = 7, cars = " << cars
                        << ",\nrun = function()\n"
                        << body << "\nend }\n";
    world::Recording recording;
    recording.episode = scripting::load_episode(path, {{}, {}, seconds, {}});
    recording.episode.scenario_path = "test.lua";
    std::filesystem::remove(path);
    recording.town = towns::read_town(network);
    recording.network = network.xml;
    recording.episode.town_digest = world::digest128(recording.network);
    return recording;
}

}  // namespace

world::Recording in_town1(const std::string& body, unsigned cars, double seconds) {
    static const towns::Network network =
        towns::load_network(std::string(REPRISE_SOURCE) + "/scenarios/towns/town1/town1.net.xml");
    return recording_of(network, body, cars, seconds);
}

world::Recording on_straight_lanes(const std::string& body, double seconds) {
    static const towns::Network network =
        towns::load_network(std::string(REPRISE_SOURCE) + "/tests/maps/lanes.net.xml");
    return recording_of(network, body, 0, seconds);
}

world::Recording in_town(const std::string& town, const std::string& body, double seconds) {
    const towns::Network network = towns::load_network(
        std::string(REPRISE_SOURCE) + "/scenarios/towns/" + town + "/" + town + ".net.xml");
    return recording_of(network, body, 0, seconds);
}

KeptTick::KeptTick(const world::SealedTick& tick)
    : tick_(tick.tick_bytes().begin(), tick.tick_bytes().end()),
      traffic_(tick.traffic_bytes().begin(), tick.traffic_bytes().end()) {}

replay::RecordedTick KeptTick::recorded() const {
    return {{world::GetTick(tick_.data()), world::GetTraffic(traffic_.data())}, tick_, traffic_};
}

std::vector<KeptTick> run(const world::Recording& recording,
                          const std::function<void(kernel::Kernel&)>& prepare) {
    kernel::Kernel kernel(recording);
    if (prepare)
        prepare(kernel);
    std::vector<KeptTick> ticks;
    while (!kernel.finished())
        ticks.emplace_back(kernel.step());
    return ticks;
}

}  // namespace reprise::test
