#include "towns/import/united_greens.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace reprise::towns {
namespace {

using ::testing::ElementsAre;

/// Two junctions side by side under one program: at each a road to the east (links 0 and 2) meets
/// one to the north (1 and 3); walkers cross the second road to the north (link 4).
constexpr const char* two_junctions = R"(<net>
<edge id="a"/><edge id="b"/><edge id="c"/><edge id="d"/><edge id="x"/>
<edge id=":j_w0" function="walkingarea"/><edge id=":j_c0" function="crossing"/>
<junction id="i" incLanes="a_0 b_0"><request index="0" foes="10" response="00"/>
  <request index="1" foes="01" response="00"/></junction>
<junction id="j" incLanes="c_0 d_0 :j_w0_0"><request index="0" foes="010" response="000"/>
  <request index="1" foes="101" response="000"/><request index="2" foes="010" response="000"/></junction>
<connection from="a" to="x" fromLane="0" toLane="0" via=":i_0_0" tl="t" linkIndex="0"/>
<connection from="b" to="x" fromLane="0" toLane="0" via=":i_1_0" tl="t" linkIndex="1"/>
<connection from="c" to="x" fromLane="0" toLane="0" via=":j_0_0" tl="t" linkIndex="2"/>
<connection from="d" to="x" fromLane="0" toLane="0" via=":j_1_0" tl="t" linkIndex="3"/>
<connection from=":j_w0" to=":j_c0" fromLane="0" toLane="0" tl="t" linkIndex="4"/>
<tlLogic id="t"></tlLogic></net>)";

/// The states of the phases that come out; none: it was left as it is.
std::vector<std::string> united(const std::vector<std::string>& greens) {
    pugi::xml_document document;
    document.load_string(two_junctions);
    pugi::xml_node net = document.child("net"), program = net.child("tlLogic");
    for (const std::string& green : greens)
        for (const char* duration : {"31", "5", "3"}) {
            pugi::xml_node phase = program.append_child("phase");
            phase.append_attribute("duration").set_value(duration);
            std::string state = green;
            for (char& c : state)
                if (duration[0] == '3' && duration[1] == '\0' && c == 'G')
                    c = 'y';
            phase.append_attribute("state").set_value(state.c_str());
        }
    std::vector<std::string> states;
    if (!unite_greens(program, net, JunctionLinks(net)))
        return states;
    for (const pugi::xml_node phase : program.children("phase"))
        states.push_back(std::string(phase.attribute("duration").value()) + " " +
                         phase.attribute("state").value());
    return states;
}

TEST(UnitedGreens, AreOfThoseWhoMeetNobody) {
    EXPECT_THAT(united({"GrrrG", "rGrrr", "rrGrG", "rrrGr"}),
                ElementsAre("37 GrGrG", "5 GrGrr", "3 yryrr", "37 rGrGr", "5 rGrGr", "3 ryryr"));
}

TEST(UnitedGreens, KeepTheLastGreenOfACrossing) {
    EXPECT_THAT(united({"GrrrG", "rrrGr"}), ElementsAre()) << "together walkers would have none";
    EXPECT_THAT(united({"Grrrr", "rrrGr"}), ElementsAre("82 GrrGr", "5 GrrGr", "3 GrrGr"));
}

TEST(UnitedGreens, OfThoseWhoMeetAreLeftAlone) {
    EXPECT_THAT(united({"GrrGr", "rGGrG"}), ElementsAre());
}

TEST(UnitedGreens, StayWithThoseWhoHadGreenTogetherThoughTheyMeet) {
    EXPECT_THAT(united({"ggrrr", "rrGrG"}), ElementsAre("82 ggGrG", "5 ggGrG", "3 ggGrG"));
}

}  // namespace
}  // namespace reprise::towns
