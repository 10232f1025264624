#include "towns/network/zippers.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/support/towns.h"
#include "tests/traffic/stage.h"
#include "towns/maps/netconvert.h"
#include "towns/network/junction_links.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;

/// Roads of one lane that become one, where their cars take turns.
class Zipper : public ::testing::Test {
  protected:
    Zipper()
        : folder_(fs::path(::testing::TempDir()) / fmt::format("reprise zipper {}", getpid())) {
        fs::create_directories(folder_);
    }

    ~Zipper() override { fs::remove_all(folder_); }

    fs::path made(int roads) const {
        std::string nodes =
            R"(<node id="j" x="0" y="0" type="zipper"/><node id="e" x="300" y="0"/>)";
        std::string edges = R"(<edge id="out" from="j" to="e" numLanes="1"/>)";
        for (int i = 0; i < roads; ++i) {
            nodes += fmt::format(R"(<node id="n{0}" x="-200" y="{1}"/>)", i, 120 * (i - 1));
            edges += fmt::format(R"(<edge id="in{0}" from="n{0}" to="j" numLanes="1"/>)", i);
        }
        std::ofstream(folder_ / "z.nod.xml") << "<nodes>" << nodes << "</nodes>";
        std::ofstream(folder_ / "z.edg.xml") << "<edges>" << edges << "</edges>";
        run_sumo_tool("netconvert",
                      {"-n", "z.nod.xml", "-e", "z.edg.xml", "--no-turnarounds", "-o", "z.net.xml"},
                      folder_,
                      "zipper");
        return folder_ / "z.net.xml";
    }

    static std::string text(const pugi::xml_document& net) {
        std::ostringstream said;
        net.save(said);
        return said.str();
    }

  private:
    fs::path folder_;
};

TEST_F(Zipper, OfThreeRoadsOneGoesBeforeTheOtherInEachPairAndNobodyTakesTurns) {
    pugi::xml_document net;
    ASSERT_TRUE(net.load_file(made(3).c_str()));
    EXPECT_EQ(mend_zippers(net.child("net")), 1U);
    const JunctionLinks links(net.child("net"));
    for (const pugi::xml_node junction : net.child("net").children("junction")) {
        if (std::string(junction.attribute("id").value()) != "j")
            continue;
        EXPECT_STREQ(junction.attribute("type").value(), "priority");
        const JunctionRows rows(junction);
        std::multiset<std::string> states;
        for (const JunctionLink& one : links.through(junction)) {
            states.insert(one.xml.attribute("state").value());
            for (const JunctionLink& other : links.through(junction))
                EXPECT_EQ(
                    rows.gives_way(one.index, other.index) + rows.gives_way(other.index, one.index),
                    one.index == other.index ? 0 : 1)
                    << one.from << " and " << other.from;
        }
        EXPECT_EQ(states, (std::multiset<std::string>{"M", "m", "m"}));
    }
    EXPECT_EQ(mend_zippers(net.child("net")), 0U) << "twice is as good as once";
}

TEST_F(Zipper, OfTwoRoadsStaysOneAsSumoKnowsIt) {
    pugi::xml_document net;
    ASSERT_TRUE(net.load_file(made(2).c_str()));
    const std::string before = text(net);
    ASSERT_NE(before.find("state=\"Z\""), std::string::npos);
    EXPECT_EQ(mend_zippers(net.child("net")), 0U);
    EXPECT_EQ(text(net), before);
}

TEST_F(Zipper, OfThreeRoadsIsDrivenThroughFromEachOfThem) {
    const test::Loaded loaded = test::load(made(3));
    test::Stage stage(loaded, 12);
    std::set<std::string> came_from;
    for (int i = 0; i < 2'400; ++i)
        for (const world::CarState& car : stage.step().traffic.cars)
            if (car.lane() != world::none &&
                loaded.town.lanes[car.lane()].junction != world::none &&
                loaded.town.lanes[car.lane()].kind == world::LaneKind::internal)
                came_from.insert(loaded.town.lanes[car.lane()].name);
    EXPECT_GE(came_from.size(), 3U);
}

}  // namespace
}  // namespace reprise::towns
