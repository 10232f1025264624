// Prints a digest of each picture of a street, by day, in rain and at nightfall. Equal output on
// two CPUs, or in two emulations of one, means equal pictures. usage: portable_pictures [normal]
#include <cstdio>
#include <string_view>

#include "tests/render/street.h"
#include "world/digest.h"

int main(int argc, char**) {
    using namespace reprise;
    render::Sensors sensors(test::street(), {.portable = argc == 1});
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
