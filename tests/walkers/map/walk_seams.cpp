// Where nobody gets from one piece of a town's pavement to the next, on either of its walk maps:
// walk_seams NETWORK.net.xml ...
#include <chrono>
#include <cstdio>
#include <exception>

#include "tests/support/towns.h"
#include "tests/walkers/map/seams.h"
#include "walkers/walking_ground.h"

namespace {

void tell(const char* name,
          const reprise::world::TownT& town,
          const reprise::walkers::WalkMap& map) {
    const reprise::test::Seams seams = reprise::test::seams_of(town, map);
    std::printf("  %s: %zu polygons, %zu kB; %d pairs, %d with a side off the map, %zu seams\n",
                name,
                map.polygons(),
                map.bytes() / 1000,
                seams.pairs,
                seams.off,
                seams.all.size());
    for (const reprise::test::Seam& seam : seams.all)
        std::printf("    %s to %s: %s at %.2f, %.2f\n",
                    seam.from.c_str(),
                    seam.to.c_str(),
                    seam.why.c_str(),
                    seam.stuck_at.x(),
                    seam.stuck_at.y());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        for (int i = 1; i < argc; ++i) {
            const auto loaded = reprise::test::load(argv[i]);
            const auto start = std::chrono::steady_clock::now();
            reprise::walkers::WalkingGround ground(loaded.town);
            ground.pavement();
            ground.streets();
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
            std::printf("%s: both maps in %.2f s\n", argv[i], took.count());
            tell("pavement", loaded.town, ground.pavement());
            tell("streets", loaded.town, ground.streets());
        }
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "walk_seams: %s\n", failure.what());
        return 2;
    }
}
