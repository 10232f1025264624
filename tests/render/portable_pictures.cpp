// Prints a digest of each picture of a street, bare and furnished, by day, in rain and at
// nightfall. Equal output on two CPUs, or in two emulations of one, means equal pictures. usage:
// portable_pictures [normal|furnished]: not portable; furnished only, which has all that the bare
// street has
#include <cstdio>
#include <string_view>

#include "tests/render/everything.h"
#include "tests/render/street.h"
#include "world/digest.h"

namespace {

using namespace reprise;

void print_digests(const world::TownT& town, bool portable) {
    render::Sensors sensors(town, {.portable = portable});
    const world::SealedTick tick = test::street_tick();
    for (const auto& [name, weather] : test::weathers()) {
        for (const world::SensorFrame& frame :
             sensors.observe(tick.view(), test::street_rig(), weather)) {
            const std::string_view bytes(reinterpret_cast<const char*>(frame.data.data()),
                                         frame.data.size());
            std::printf("%s %d %s\n",
                        name,
                        static_cast<int>(frame.kind),
                        world::to_hex(world::digest128(bytes)).c_str());
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string_view asked = argc == 1 ? "" : argv[1];
    const bool portable = asked != "normal";
    if (asked != "furnished")
        print_digests(test::street(), portable);
    world::TownT furnished = test::street();
    for (const world::Prop& prop : test::all_props())
        furnished.props.push_back(prop);
    for (const world::Tree& plant : test::all_plants())
        furnished.trees.push_back(plant);
    furnished.plots = {test::plot(world::PlotKind::park, 60, 12, 90, 40)};
    furnished.buildings = {test::building_of(20, 70, 16, 0), test::building_of(34, 80, -18, 3.1)};
    print_digests(furnished, portable);
}
