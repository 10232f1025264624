#include "towns/network/joined_lanes.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/support/towns.h"
#include "towns/maps/netconvert.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;

/// A road of three lanes to the east, joined by a road from `ramp` that ends on `lanes` of it.
class Join : public ::testing::Test {
  protected:
    Join()
        : folder_(fs::path(::testing::TempDir()) / ("reprise join " + std::to_string(getpid()))) {
        fs::create_directories(folder_);
    }

    ~Join() override { fs::remove_all(folder_); }

    pugi::xml_document made(const std::string& ramp, const std::string& lanes, bool every_lane) {
        write("join.nod.xml",
              "<nodes><node id=\"w\" x=\"-300\" y=\"0\"/><node id=\"j\" x=\"0\" y=\"0\" "
              "type=\"priority\"/><node id=\"e\" x=\"300\" y=\"0\"/><node id=\"r\" " +
                  ramp + "/></nodes>");
        write("join.edg.xml",
              "<edges><edge id=\"in\" from=\"w\" to=\"j\" numLanes=\"3\" priority=\"3\"/><edge "
              "id=\"out\" from=\"j\" to=\"e\" numLanes=\"3\" priority=\"3\"/><edge id=\"ramp\" "
              "from=\"r\" to=\"j\" numLanes=\"1\" priority=\"1\"/></edges>");
        write("join.con.xml", "<connections>" + lanes + "</connections>");
        run_sumo_tool("netconvert",
                      {"-n",
                       "join.nod.xml",
                       "-e",
                       "join.edg.xml",
                       "-x",
                       "join.con.xml",
                       "--check-lane-foes.all",
                       every_lane ? "false" : "true",
                       "--no-turnarounds",
                       "-o",
                       "join.net.xml"},
                      folder_,
                      "join");
        pugi::xml_document net;
        EXPECT_TRUE(net.load_file((folder_ / "join.net.xml").c_str()));
        return net;
    }

    /// Who gives way to whom, and as what links are known.
    static std::string rules(const pugi::xml_document& net) {
        std::ostringstream said;
        for (const pugi::xml_node junction : net.child("net").children("junction"))
            for (const pugi::xml_node request : junction.children("request"))
                request.print(said, "");
        for (const pugi::xml_node link : net.child("net").children("connection"))
            said << link.attribute("from").value() << link.attribute("fromLane").value() << " "
                 << link.attribute("state").value() << "\n";
        return said.str();
    }

  private:
    void write(const char* name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }

    fs::path folder_;
};

constexpr const char* gentle = "x=\"-250\" y=\"-60\"";
constexpr const char* across = "x=\"0\" y=\"-150\"";
const std::string every_lane_goes_on =
    "<connection from=\"in\" to=\"out\" fromLane=\"0\" toLane=\"0\"/><connection from=\"in\" "
    "to=\"out\" fromLane=\"1\" toLane=\"1\"/><connection from=\"in\" to=\"out\" fromLane=\"2\" "
    "toLane=\"2\"/>";

std::string joins(int lane) {
    return "<connection from=\"ramp\" to=\"out\" fromLane=\"0\" toLane=\"" + std::to_string(lane) +
           "\"/>";
}

/// The other route: netconvert itself, told to look at lanes.
TEST_F(Join, WhoComesFromARampLetsThoseOfItsLanePassAndNobodyElse) {
    const std::string links = every_lane_goes_on + joins(0);
    pugi::xml_document net = made(gentle, links, true);
    EXPECT_NE(rules(net), rules(made(gentle, links, false)));
    EXPECT_EQ(part_joined_lanes(net.child("net")), 2U);
    EXPECT_EQ(rules(net), rules(made(gentle, links, false)));
    EXPECT_EQ(part_joined_lanes(net.child("net")), 0U) << "once is enough";
}

/// netconvert knows that by itself today: here are the bits that a program less clever wrote.
TEST_F(Join, WhoHasALaneForHimselfIsOnAMainRoad) {
    const std::string links =
        "<connection from=\"in\" to=\"out\" fromLane=\"1\" toLane=\"1\"/><connection from=\"in\" "
        "to=\"out\" fromLane=\"2\" toLane=\"2\"/>" +
        joins(0);
    pugi::xml_document net = made(gentle, links, false);
    const std::string right = rules(net);
    const pugi::xml_node root = net.child("net");
    pugi::xml_node ramp = root.find_child_by_attribute("connection", "from", "ramp");
    pugi::xml_node request = root.find_child_by_attribute("junction", "id", "j").child("request");
    ramp.attribute("state").set_value("m");
    for (const char* row : {"response", "foes"})
        request.attribute(row).set_value("110");
    ASSERT_NE(rules(net), right);
    EXPECT_EQ(part_joined_lanes(root), 2U);
    EXPECT_EQ(rules(net), right);
}

TEST_F(Join, WhoCrossesALaneLetsItPass) {
    pugi::xml_document net = made("x=\"-250\" y=\"-30\"", every_lane_goes_on + joins(1), true);
    EXPECT_EQ(part_joined_lanes(net.child("net")), 1U) << "of the third lane he keeps apart";
}

/// A bus that turns there swings out over the lane beside.
TEST_F(Join, WhoTurnsTightlyLetsAllLanesPass) {
    pugi::xml_document net = made(across, every_lane_goes_on + joins(0), true);
    const std::string before = rules(net);
    EXPECT_EQ(part_joined_lanes(net.child("net")), 0U);
    EXPECT_EQ(rules(net), before);
}

/// Bits are by number of a link: those of walkers and of other roads count.
TEST(JoinedLanes, OurOwnTownsHaveNoneToMend) {
    for (const char* town : {"town1", "town2", "junctions"}) {
        pugi::xml_document net;
        ASSERT_TRUE(net.load_string(test::own_town(town).network.xml.c_str()));
        EXPECT_EQ(part_joined_lanes(net.child("net")), 0U) << town;
    }
}

}  // namespace
}  // namespace reprise::towns
