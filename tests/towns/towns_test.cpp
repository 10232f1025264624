#include "tests/support/towns.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"

namespace reprise::towns {
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
          towns_(fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns"),
          make_(fs::path(REPRISE_SOURCE_DIR) / "towns/make") {
        fs::create_directories(out_);
    }

    ~Towns() override { fs::remove_all(out_); }

    fs::path out_;
    fs::path towns_;
    fs::path make_;
};

INSTANTIATE_TEST_SUITE_P(Own, Towns, ::testing::Values("town1", "town2"));

class MadeTowns : public Towns {};

INSTANTIATE_TEST_SUITE_P(All,
                         MadeTowns,
                         ::testing::Values("town1", "town2", "straight", "curves", "junctions"));

TEST_P(MadeTowns, BuildingTheNetworkAgainGivesTheSameBytes) {
    const std::string name = GetParam();
    const std::string call =
        (make_ / "build.sh").string() + " " + name + " " + out_.string() + " >/dev/null 2>&1";
    ASSERT_EQ(std::system(call.c_str()), 0) << call;
    EXPECT_EQ(bytes(out_ / (name + ".net.xml")), bytes(towns_ / name / (name + ".net.xml")));
}

TEST_P(MadeTowns, TheGeneratorGivesTheSameSources) {
    const std::string name = GetParam();
    const std::string call = "python3 " + (make_ / "make_town.py").string() + " " + name + " " +
                             out_.string() + " >/dev/null";
    ASSERT_EQ(std::system(call.c_str()), 0) << call;
    for (const char* ending : {".nod.xml", ".edg.xml", ".con.xml", ".typ.xml", ".place.xml"}) {
        const std::string made = bytes(out_ / (name + ending));
        EXPECT_FALSE(made.empty());
        EXPECT_EQ(made, bytes(towns_ / name / (name + ending))) << ending;
    }
}

double polyline_length(const std::vector<world::Vec3>& line) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += std::hypot(line[i].x() - line[i - 1].x(), line[i].y() - line[i - 1].y());
    return length;
}

/// [m] of drivable roads as scenarios/towns/README.md defines it: along the middle of every street
/// from junction to junction, the two directions of a street once.
double street_length(const std::string& name) {
    pugi::xml_document file;
    file.load_string(test::own_town(name).network.xml.c_str());
    std::map<std::string, world::Vec3> junctions;
    for (const pugi::xml_node junction : file.child("net").children("junction"))
        junctions[junction.attribute("id").value()] = {
            junction.attribute("x").as_double(), junction.attribute("y").as_double(), 0};
    std::map<std::pair<std::string, std::string>, double> streets;
    for (const pugi::xml_node edge : file.child("net").children("edge")) {
        if (edge.attribute("function"))
            continue;
        const std::string from = edge.attribute("from").value();
        const std::string to = edge.attribute("to").value();
        // netconvert leaves the shape out where it is a straight line.
        const std::vector<world::Vec3> line =
            edge.attribute("shape") ? parse_shape(edge.attribute("shape").value())
                                    : std::vector{junctions.at(from), junctions.at(to)};
        streets[std::minmax(from, to)] = polyline_length(line);
    }
    double length = 0;
    for (const auto& [ends, street] : streets)
        length += street;
    return length;
}

TEST(TownLengths, AreThoseOfThePaper) {
    EXPECT_NEAR(street_length("town1"), 2900, 29);
    EXPECT_NEAR(street_length("town2"), 1400, 14);
}

/// [junction] how many streets and one-way pieces meet there.
std::map<std::uint32_t, std::size_t> arms(const world::TownT& town) {
    std::map<std::uint32_t, std::set<std::string>> edges;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving) {
            edges[lane.junction].insert(lane.edge);
        }
    std::map<std::uint32_t, std::size_t> count;
    for (const auto& [junction, into] : edges)
        count[junction] = into.size();
    return count;
}

TEST_P(Towns, HoldAllThatATownIsDrivenThroughFor) {
    const world::TownT& town = test::own_town(GetParam()).town;
    std::set<double> limits;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving)
            limits.insert(lane.speed_limit);
    EXPECT_EQ(limits, (std::set{8.33, 13.89, 16.67}));
    const auto into = arms(town);
    EXPECT_TRUE(std::any_of(into.begin(), into.end(), [](const auto& one) {
        return one.second == 4;
    })) << "a crossing of two streets";
    std::set<std::string> kinds;
    std::set<char> states;
    pugi::xml_document file;
    file.load_string(test::own_town(GetParam()).network.xml.c_str());
    for (const pugi::xml_node junction : file.child("net").children("junction"))
        kinds.insert(junction.attribute("type").value());
    EXPECT_TRUE(kinds.contains("traffic_light"));
    EXPECT_TRUE(kinds.contains("priority"));
    EXPECT_TRUE(kinds.contains("priority_stop"));
    for (const pugi::xml_node connection : file.child("net").children("connection"))
        states.insert(*connection.attribute("state").value());
    EXPECT_TRUE(states.contains('s')) << "stop signs";
    EXPECT_TRUE(states.contains('m')) << "yield signs";
    for (const pugi::xml_node edge : file.child("net").children("edge"))
        EXPECT_TRUE(edge.attribute("function") || edge.attribute("name"))
            << edge.attribute("id").value() << " has no name";
}

TEST_P(Towns, OnlyMinorRoadsStop) {
    pugi::xml_document file;
    file.load_string(test::own_town(GetParam()).network.xml.c_str());
    const pugi::xml_node net = file.child("net");
    std::set<std::string> stopping;
    for (const pugi::xml_node connection : net.children("connection"))
        if (*connection.attribute("state").value() == 's')
            stopping.insert(connection.attribute("from").value());
    std::map<std::string, int> highest;  // of the roads into a junction with stops
    for (const pugi::xml_node junction : net.children("junction"))
        if (std::string(junction.attribute("type").value()) == "priority_stop")
            highest[junction.attribute("id").value()] = 0;
    EXPECT_GE(highest.size(), 2U);
    std::map<std::string, int> stops;
    for (const bool looks : {true, false})
        for (const pugi::xml_node edge : net.children("edge")) {
            const auto main = highest.find(edge.attribute("to").value());
            if (main == highest.end())
                continue;
            const int priority = edge.attribute("priority").as_int();
            if (looks) {
                main->second = std::max(main->second, priority);
                continue;
            }
            EXPECT_EQ(stopping.contains(edge.attribute("id").value()), priority < main->second)
                << edge.attribute("id").value();
            stops[main->first] += stopping.contains(edge.attribute("id").value()) ? 1 : 0;
        }
    for (const auto& [junction, roads] : stops)
        EXPECT_EQ(roads, 1) << "of three at " << junction;
}

}  // namespace
}  // namespace reprise::towns
