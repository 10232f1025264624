// Prints a digest of each picture of a street, bare and furnished, by day, in rain and at
// nightfall, and of what LiDAR, radar and obstacle sensor measure there. Equal output on two CPUs,
// or in two emulations of one, means equal pictures. usage: portable_pictures [normal|furnished]:
// not portable; furnished only, which has all that the bare street has
#include <cstdio>
#include <string_view>

#include "tests/render/everything.h"
#include "tests/render/street.h"
#include "world/digest.h"

namespace {

using namespace reprise;

void print_digest(const char* name, const world::SensorFrame& frame) {
    const std::string_view bytes(reinterpret_cast<const char*>(frame.data.data()),
                                 frame.data.size());
    std::printf("%s %d %s\n",
                name,
                static_cast<int>(frame.kind),
                world::to_hex(world::digest128(bytes)).c_str());
}

/// What measures by rays, in clear air.
void print_ranging(render::Sensors& sensors, const world::SealedTick& tick) {
    for (const world::SensorKind kind : {world::SensorKind::lidar,
                                         world::SensorKind::semantic_lidar,
                                         world::SensorKind::radar,
                                         world::SensorKind::obstacle}) {
        world::SensorSpec spec;
        spec.name = "ranger";
        spec.kind = kind;
        spec.actor = 1;
        spec.position = {1.2, 0, 1.8};
        spec.attributes = {{"range", 80}};
        if (kind == world::SensorKind::lidar || kind == world::SensorKind::radar)
            spec.attributes.push_back({"weather", 0});
        if (kind == world::SensorKind::obstacle)
            spec.attributes = {{"distance", 80}};
        const world::SensorFrame frame = sensors.observe(tick.view(), {spec}, test::noon())[0];
        if (frame.height == 0)
            std::printf("nothing was measured\n");
        print_digest("clear_air", frame);
    }
}

void print_digests(const world::TownT& town, bool portable) {
    render::Sensors sensors(town, {.portable = portable});
    const world::SealedTick tick = test::street_tick();
    for (const auto& [name, weather] : test::weathers()) {
        for (const world::SensorFrame& frame :
             sensors.observe(tick.view(), test::street_rig(), weather))
            print_digest(name, frame);
    }
    print_ranging(sensors, tick);
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
