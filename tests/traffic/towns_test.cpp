#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/traffic/stage.h"

namespace reprise::traffic {
namespace {

namespace fs = std::filesystem;

std::string bytes(const fs::path& path) {
    std::ostringstream all;
    all << std::ifstream(path, std::ios::binary).rdbuf();
    return std::move(all).str();
}

class Towns : public ::testing::TestWithParam<const char*> {
  protected:
    Towns()
        : out_(fs::path(::testing::TempDir()) / ("reprise_towns_" + std::to_string(getpid()))),
          towns_(fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns") {
        fs::create_directories(out_);
    }

    ~Towns() override { fs::remove_all(out_); }

    fs::path out_;
    fs::path towns_;
};

INSTANTIATE_TEST_SUITE_P(Own, Towns, ::testing::Values("town1", "town2"));

TEST_P(Towns, BuildingTheNetworkAgainGivesTheSameBytes) {
    const std::string name = GetParam();
    const std::string call =
        (towns_ / "build.sh").string() + " " + name + " " + out_.string() + " >/dev/null 2>&1";
    ASSERT_EQ(std::system(call.c_str()), 0) << call;
    EXPECT_EQ(bytes(out_ / (name + ".net.xml")), bytes(towns_ / name / (name + ".net.xml")));
}

TEST_P(Towns, TheGeneratorGivesTheSameSources) {
    const std::string name = GetParam();
    const std::string call = "python3 " + (towns_ / "make_town.py").string() + " " + name + " " +
                             out_.string() + " >/dev/null";
    ASSERT_EQ(std::system(call.c_str()), 0) << call;
    for (const char* ending : {".nod.xml", ".edg.xml", ".con.xml", ".typ.xml"}) {
        const std::string made = bytes(out_ / (name + ending));
        EXPECT_FALSE(made.empty());
        EXPECT_EQ(made, bytes(towns_ / name / (name + ending))) << ending;
    }
}

/// [m] of streets: from junction to junction along the middle, one direction of each.
double street_length(const world::TownT& town) {
    double length = 0;
    std::set<std::string> seen;
    for (const world::LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::driving || !seen.insert(lane.edge).second)
            continue;
        // The lane, and from its ends to the middles of the junctions there. Both directions: half.
        const std::string from = lane.edge.substr(0, lane.edge.find('_'));
        for (const world::JunctionT& junction : town.junctions) {
            const bool starts = junction.name == from;
            if (!starts && junction.name != town.junctions[lane.junction].name)
                continue;
            const world::Vec3& end = starts ? lane.centre.front() : lane.centre.back();
            length += std::hypot(end.x() - junction.centre.x(), end.y() - junction.centre.y()) / 2;
        }
        length += lane.length / 2;
    }
    return length;
}

TEST(TownLengths, AreThoseOfThePlans) {
    EXPECT_NEAR(street_length(test::own_town("town1").town), 2900, 29);
    EXPECT_NEAR(street_length(test::own_town("town2").town), 1400, 14);
}

}  // namespace
}  // namespace reprise::traffic
