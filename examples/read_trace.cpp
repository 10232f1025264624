// Records five seconds, then reads the trace back without a kernel: the fastest car of every
// second.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "kernel/kernel.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"

namespace {

void record(const std::filesystem::path& path) {
    using namespace reprise;
    world::Recording recording;
    recording.episode = scripting::load_episode("scenarios/free_drive.lua", {{}, 7, 5.0, {}});
    towns::Network network = towns::load_network("scenarios/towns/town2/town2.net.xml");
    recording.town = towns::read_town(network);
    recording.network = std::move(network.xml);
    replay::TraceWriter trace(path, recording);
    kernel::Kernel kernel(recording);
    while (!kernel.finished())
        trace.append(kernel.step());
    trace.close(kernel.outcome());
}

}  // namespace

int main() {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / "reprise_read_trace_example.mcap";
    record(path);
    reprise::replay::TraceReader trace(path);
    for (std::uint64_t index = 20; index <= trace.ticks(); index += 20) {
        const auto cars = trace.tick(index).view.cars();
        const auto fastest =
            std::max_element(cars.begin(), cars.end(), [](const auto& one, const auto& other) {
                return one.speed() < other.speed();
            });
        if (fastest == cars.end())
            return 1;
        fmt::print("tick {}: car {} leads {} cars with {:.1f} m/s\n",
                   index,
                   fastest->id(),
                   cars.size(),
                   static_cast<double>(fastest->speed()));
    }
    std::filesystem::remove(path);
    return trace.ticks() == 100 ? 0 : 1;
}
