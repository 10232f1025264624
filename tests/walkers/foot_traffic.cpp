// How the people of recorded runs walk: whether anybody is inside of a car or of what stands there,
// and how everybody comes onto the road. A table for each trace, and behind --places where.
#include "tests/support/foot_traffic.h"

#include <cstdio>
#include <exception>
#include <string_view>

#include "replay/trace_reader.h"

namespace {

void tell(const char* path, bool with_places) {
    reprise::replay::TraceReader trace(path);
    const reprise::world::TownT& town = trace.recording().town;
    const reprise::world::LaneMap lanes(town);
    reprise::test::FootTraffic people(
        town, lanes, static_cast<double>(trace.episode().step_ns) * 1e-9);
    for (std::uint64_t tick = trace.first(); tick <= trace.last(); ++tick)
        people.see(trace.tick(tick).view);
    std::printf("%s\n%s\n", path, people.text().c_str());
    if (with_places)
        std::printf("%s\n", people.places().c_str());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const bool with_places = argc > 1 && std::string_view(argv[1]) == "--places";
        for (int i = with_places ? 2 : 1; i < argc; ++i)
            tell(argv[i], with_places);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "foot_traffic: %s\n", failure.what());
        return 2;
    }
}
