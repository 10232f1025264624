// Networks that SUMO 1.15 would stop or crash on are refused with line and element.
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "towns/network/network.h"
#include "world/check.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A road that comes out of a lit junction of the middle of a street.
constexpr const char* street = R"(<net version="1.9">
<edge id=":b_0" function="internal"><lane id=":b_0_0" index="0" speed="5" length="2.00" shape="100.00,-1.60 102.00,-1.60"/></edge>
<edge id="ab" from="a" to="b"><lane id="ab_0" index="0" allow="pedestrian" speed="13.89" length="100.00" width="2.00" shape="0.00,-5.00 100.00,-5.00"/>
<lane id="ab_1" index="1" disallow="pedestrian" speed="13.89" length="100.00" shape="0.00,-1.60 100.00,-1.60"/></edge>
<edge id="bc" from="b" to="c"><lane id="bc_0" index="0" speed="13.89" length="98.00" shape="102.00,-1.60 200.00,-1.60"/></edge>
<tlLogic id="b" type="static" programID="0" offset="0"><phase duration="30" state="G"/><phase duration="3" state="y"/></tlLogic>
<junction id="a" type="dead_end" x="0.00" y="0.00" incLanes="" intLanes="" shape="0.00,0.00 0.00,-6.00"/>
<junction id="b" type="traffic_light" x="100.00" y="0.00" incLanes="ab_0 ab_1" intLanes=":b_0_0" shape="100.00,0.00 102.00,0.00 102.00,-6.00 100.00,-6.00">
<request index="0" response="0" foes="0" cont="0"/></junction>
<junction id="c" type="dead_end" x="200.00" y="0.00" incLanes="bc_0" intLanes="" shape="200.00,0.00 200.00,-3.20"/>
<connection from="ab" to="bc" fromLane="1" toLane="0" via=":b_0_0" tl="b" linkIndex="0" dir="s" state="o"/>
<connection from=":b_0" to="bc" fromLane="0" toLane="0" dir="s" state="M"/>
</net>)";

struct Fault {
    const char* name;
    const char* from;
    const char* to;
    std::vector<const char*> told;
};

class NetworkFaults : public testing::TestWithParam<Fault> {
  protected:
    NetworkFaults()
        : file_(fs::path(testing::TempDir()) / fmt::format("reprise_{}.net.xml", getpid())) {}

    ~NetworkFaults() override { fs::remove(file_); }

    std::string refusal(const std::string& xml) const {
        std::ofstream(file_, std::ios::binary) << xml;
        try {
            load_network(file_);
        } catch (const world::Error& error) {
            return error.what();
        }
        return "";
    }

    fs::path file_;
};

TEST_P(NetworkFaults, AreToldWithLineAndElement) {
    ASSERT_EQ(refusal(street), "");
    const std::string from = GetParam().from;
    std::string xml = street;
    ASSERT_NE(xml.find(from), std::string::npos);
    xml.replace(xml.find(from), from.size(), GetParam().to);
    const std::string told = refusal(xml);
    for (const char* part : GetParam().told)
        EXPECT_THAT(told, HasSubstr(part));
    EXPECT_EQ(told.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Every,
    NetworkFaults,
    testing::Values(
        Fault{"NoPhases",
              R"(<phase duration="30" state="G"/><phase duration="3" state="y"/>)",
              "",
              {":6: <tlLogic id=\"b\">: has no <phase>"}},
        Fault{"StateTooShort",
              R"(linkIndex="0")",
              R"(linkIndex="1")",
              {"<connection from=\"ab\"", "states for 1 links"}},
        Fault{"StatesDiffer",
              R"(state="y")",
              R"(state="yy")",
              {"<phase", "2 links, the phases before for 1"}},
        Fault{"StateUnknown", R"(state="y")", R"(state="x")", {"<phase", "state=\"x\""}},
        Fault{"NoDuration", R"(duration="3")", R"(duration="0")", {":6: <phase", "above 0"}},
        Fault{"NegativeDuration", R"(duration="3")", R"(duration="-3")", {"<phase", "above 0"}},
        Fault{"NoSuchLight", R"(tl="b")", R"(tl="x")", {"no such <tlLogic>"}},
        Fault{"NoLinkIndex", R"( linkIndex="0")", "", {"linkIndex=\"\""}},
        Fault{"NoSuchLane",
              R"(fromLane="1")",
              R"(fromLane="7")",
              {"<connection", "the edge 'ab' has 2 lanes"}},
        Fault{"NoSuchEdge",
              R"(to="bc" fromLane="1")",
              R"(to="xx" fromLane="1")",
              {"there is no such edge"}},
        Fault{"NoVia", R"( via=":b_0_0")", "", {"has no via"}},
        Fault{"NoSuchVia", R"(via=":b_0_0")", R"(via=":b_9_0")", {"there is no such lane"}},
        Fault{"ViaLeadsNowhere",
              R"(<connection from=":b_0" to="bc" fromLane="0" toLane="0" dir="s" state="M"/>)",
              "",
              {"no connection leads on from there"}},
        Fault{
            "ConnectionGone",
            R"(<connection from="ab" to="bc" fromLane="1" toLane="0" via=":b_0_0" tl="b" linkIndex="0" dir="s" state="o"/>)",
            "",
            {"of the junction 'b'", "each of its 0 links"}},
        Fault{"RequestGone",
              R"(<request index="0" response="0" foes="0" cont="0"/>)",
              R"(<request index="1" response="0" foes="0" cont="0"/>)",
              {"expected index=\"0\""}},
        Fault{"ResponseTooLong", R"(response="0")", R"(response="00")", {"response=\"00\""}},
        Fault{"FoesGone", R"( foes="0")", "", {"foes=\"\""}},
        Fault{"ContIsNothing", R"(cont="0")", R"(cont="abc")", {"cont=\"abc\""}},
        Fault{"NoFunction", R"( function="internal")", "", {"':' before their id"}},
        Fault{"UnknownFunction", R"(function="internal")", R"(function="x")", {"no function 'x'"}},
        Fault{"NoSuchJunction",
              R"(from="b" to="c")",
              R"(from="b" to="x")",
              {":5: <edge id=\"bc\"", "no such junction"}},
        Fault{"LaneIndex",
              R"(id="ab_1" index="1")",
              R"(id="ab_1" index="3")",
              {":4: <lane", "expected index=\"1\""}},
        Fault{"LaneName", R"(id="ab_1")", R"(id="ab_9")", {"expected id=\"ab_1\""}},
        Fault{"TwoEdges", R"(id="bc")", R"(id="ab")", {"another one of that id"}},
        Fault{"NoSuchIncomingLane",
              R"(incLanes="ab_0 ab_1")",
              R"(incLanes="ab_0 ab_7")",
              {"no lane 'ab_7'"}},
        Fault{"JunctionNowhere",
              R"(x="100.00" y="0.00" inc)",
              R"(x="nan" y="0.00" inc)",
              {":8: <junction", "x=\"nan\""}},
        Fault{"DirectionGone", R"(dir="s" state="o")", R"(dir="" state="o")", {"dir=\"\""}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace reprise::towns
