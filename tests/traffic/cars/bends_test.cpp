#include "traffic/cars/bends.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "world/frames.h"

namespace reprise::traffic {
namespace {

/// Three hundred metres straight on, a junction, and on the road behind it soon a narrow bend.
constexpr const char* road = R"(<net version="1.9">
<location netOffset="0,0" convBoundary="0,-100,400,0" origBoundary="0,-100,400,0" projParameter="!"/>
<edge id=":j_0" function="internal"><lane id=":j_0_0" index="0" speed="20" length="10"
  shape="300,0 310,0"/></edge>
<edge id="a" from="w" to="j" priority="1"><lane id="a_0" index="0" speed="20" length="300"
  shape="0,0 300,0"/></edge>
<edge id="b" from="j" to="e" priority="1"><lane id="b_0" index="0" speed="20" length="100.9"
  shape="310,0 322,0 323.9,-0.4 325.5,-1.5 326.6,-3.1 327,-5 327,-86"/></edge>
<junction id="w" type="dead_end" x="0" y="0" incLanes="" intLanes="" shape="0,2 0,-2"/>
<junction id="j" type="priority" x="305" y="0" incLanes="a_0" intLanes=":j_0_0"
  shape="300,2 310,2 310,-2 300,-2"><request index="0" response="0" foes="0" cont="0"/></junction>
<junction id="e" type="dead_end" x="327" y="-86" incLanes="b_0" intLanes="" shape="325,-86 329,-86"/>
<connection from="a" to="b" fromLane="0" toLane="0" via=":j_0_0" dir="s" state="M"/>
<connection from=":j_0" to="b" fromLane="0" toLane="0" dir="s" state="M"/>
</net>
)";

struct Drive {
    double turned = 0;    ///< [rad] in all
    double largest = 0;   ///< [rad] in a tick
    double sideways = 0;  ///< [m/s^2] at worst
    double fastest = 0;   ///< [m/s] while it turns
};

/// One car, spawned on lane a_0 of a network and driven until it leaves it.
Drive drive(const std::string& name, const char* network, double speed, int ticks) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "bends_test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / (name + ".net.xml")) << network;
    const test::Loaded loaded = test::load(folder / (name + ".net.xml"));
    test::Stage stage(loaded, 0);
    stage.step({test::spawn(1, test::lane(loaded.town, "a_0"), 150, speed)});
    constexpr double turns = 0.02;  // [rad]
    Drive drive;
    double yaw = 0;
    for (int tick = 0; tick < ticks; ++tick) {
        stage.step();
        const world::CarState* car = stage.car(1);
        if (car == nullptr)
            break;
        const double turn = std::abs(world::wrap_angle(static_cast<double>(car->yaw()) - yaw));
        const auto now = static_cast<double>(car->speed());
        drive.turned += turn;
        drive.largest = std::max(drive.largest, turn);
        drive.sideways = std::max(drive.sideways, now * turn / 0.05);
        if (turn > turns)
            drive.fastest = std::max(drive.fastest, now);
        yaw = static_cast<double>(car->yaw());
    }
    return drive;
}

TEST(Bends, SoonBehindAJunctionAreSeenFromBeforeIt) {
    const Drive driven = drive("road", road, 15, 900);
    EXPECT_NEAR(driven.turned, 1.571, 0.1) << "it is no proof before the bend";
    EXPECT_LT(driven.sideways, 6) << "without it 21";
}

/// A street whose halves join within three metres, as where two junctions of a map became one.
constexpr const char* hairpin = R"(<net version="1.9">
<location netOffset="0,0" convBoundary="0,0,210,3" origBoundary="0,0,210,3" projParameter="!"/>
<edge id=":j_0" function="internal"><lane id=":j_0_0" index="0" speed="20" length="4.7"
  shape="200,0 201.1,0.4 201.5,1.5 201.1,2.6 200,3"/></edge>
<edge id="a" from="w" to="j" priority="1"><lane id="a_0" index="0" speed="20" length="200"
  shape="0,0 200,0"/></edge>
<edge id="b" from="j" to="e" priority="1"><lane id="b_0" index="0" speed="20" length="200"
  shape="200,3 0,3"/></edge>
<junction id="w" type="dead_end" x="0" y="0" incLanes="" intLanes="" shape="0,2 0,-2"/>
<junction id="j" type="priority" x="201" y="1.5" incLanes="a_0" intLanes=":j_0_0"
  shape="200,-2 204,-2 204,5 200,5"><request index="0" response="0" foes="0" cont="0"/></junction>
<junction id="e" type="dead_end" x="0" y="3" incLanes="" intLanes="" shape="0,1 0,5"/>
<connection from="a" to="b" fromLane="0" toLane="0" via=":j_0_0" dir="t" state="M"/>
<connection from=":j_0" to="b" fromLane="0" toLane="0" dir="s" state="M"/>
</net>
)";

TEST(Bends, NobodySpeedsUpBeforeAllOfHimHasTurnedRound) {
    const Drive driven = drive("hairpin", hairpin, 10, 600);
    EXPECT_NEAR(driven.turned, 3.142, 0.2) << "it is no proof before it has turned";
    EXPECT_LT(driven.largest * 180 / 3.14159, 10) << "degrees a tick";
    EXPECT_LT(driven.fastest, 3) << "[m/s]; without it 5.6";
}

}  // namespace
}  // namespace reprise::traffic
