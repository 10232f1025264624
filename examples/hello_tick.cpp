// The smallest program around the kernel: a scenario, a town, and steps.
// Prints where the car is, once a second.
#include <fmt/format.h>

#include "kernel/kernel.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/tick.h"

int main() {
    using namespace reprise;
    world::Recording recording;
    recording.episode = scripting::load_episode("examples/hello.lua", {});
    towns::Network network = towns::load_network("scenarios/towns/town1/town1.net.xml");
    recording.town = towns::read_town(network);
    recording.network = std::move(network.xml);

    kernel::Kernel kernel(recording);
    while (!kernel.finished()) {
        const world::TickView tick = kernel.step().view();
        if (tick.index() % 20 != 0 || tick.vehicles().empty())
            continue;
        const world::VehicleState& car = tick.vehicles().front();
        fmt::print("{:.1f} s: the sedan is at ({:.2f}, {:.2f}), {:.1f} m driven, among {} cars\n",
                   world::seconds(tick.index(), recording.episode.step_ns),
                   car.position().x(),
                   car.position().y(),
                   car.odometer(),
                   tick.cars().size());
    }
    return kernel.outcome().ticks == 100 ? 0 : 1;
}
