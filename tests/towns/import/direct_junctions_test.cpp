// Roads that part without connecting roads: OpenDRIVE's <junction type="direct">.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/towns/import/imports.h"
#include "towns/town_reader.h"
#include "world/frames.h"

namespace reprise::towns {
namespace {

using ::testing::HasSubstr;

std::string lane(int id) {
    return fmt::format(
        "<lane id='{}' type='driving'><width sOffset='0' a='3.5' b='0' c='0' d='0'/></lane>", id);
}

/// Three lanes eastwards. At x = 100 the two on the left go on as road 2, the right one as road 3,
/// 0.2 rad to the right, which is drawn backwards, so that its lane is number 1. `mirrored`: the
/// same for those who drive on the left, about the x axis.
std::string parting(const std::string& linked = "3", bool mirrored = false) {
    const int sign = mirrored ? -1 : 1;
    const std::string rule = mirrored ? " rule='LHT'" : "";
    const std::string side = mirrored ? "left" : "right";
    const auto centre = "<center><lane id='0' type='none'/></center>";
    const auto sections = [&](const std::string& of, const std::string& lanes) {
        const std::string part = fmt::format("<{0}>{1}</{0}>", of, lanes);
        return fmt::format("<lanes><laneSection s='0'>{}</laneSection></lanes>",
                           of == "left" ? part + centre : centre + part);
    };
    const auto lanes_of = [&](int count) {
        std::string lanes;
        for (int i = 1; i <= count; ++i)
            lanes.insert(mirrored ? 0 : lanes.size(), lane(-sign * i));
        return sections(side, lanes);
    };
    return fmt::format(
        R"(<?xml version='1.0'?>
<OpenDRIVE><header revMajor='1' revMinor='7'/>
<road id='1' length='100' junction='-1'{rule}><link><successor elementType='junction' elementId='4'/></link>
<planView><geometry s='0' x='0' y='0' hdg='0' length='100'><line/></geometry></planView>
<elevationProfile><elevation s='0' a='5' b='0' c='0' d='0'/></elevationProfile>{three}</road>
<road id='2' length='100' junction='-1'{rule}><link><predecessor elementType='junction' elementId='4'/></link>
<planView><geometry s='0' x='100' y='0' hdg='0' length='100'><line/></geometry></planView>
<elevationProfile><elevation s='0' a='5' b='0' c='0' d='0'/></elevationProfile>{two}</road>
<road id='3' length='100' junction='-1'{rule}><link><successor elementType='junction' elementId='4'/></link>
<planView><geometry s='0' x='198.006658' y='{y}' hdg='{hdg}' length='100'><line/></geometry></planView>
<elevationProfile><elevation s='0' a='5' b='0' c='0' d='0'/></elevationProfile>{ramp}</road>
<junction id='4' type='direct'>
<connection id='0' incomingRoad='1' linkedRoad='2' contactPoint='start'><laneLink from='{a}' to='{a}'/><laneLink from='{b}' to='{b}'/></connection>
<connection id='1' incomingRoad='1' linkedRoad='{linked}' contactPoint='end'><laneLink from='{c}' to='{d}'/></connection>
</junction></OpenDRIVE>)",
        fmt::arg("rule", rule),
        fmt::arg("three", lanes_of(3)),
        fmt::arg("two", lanes_of(2)),
        fmt::arg("ramp", sections(mirrored ? "right" : "left", lane(sign))),
        fmt::arg("y", -sign * 26.866933),
        fmt::arg("hdg", sign * 2.941592654),
        fmt::arg("linked", linked),
        fmt::arg("a", -sign),
        fmt::arg("b", -sign * 2),
        fmt::arg("c", -sign * 3),
        fmt::arg("d", sign));
}

class DirectJunctions : public Imports {};

TEST_F(DirectJunctions, JoinTheLanesThatTheMapJoins) {
    for (const bool mirrored : {false, true}) {
        const std::string name = mirrored ? "left" : "right";
        import_town({write(name + ".xodr", parting("3", mirrored)), "", false, false}, empty(name));
        const world::TownT town = read_town(load_network(folder_ / name / (name + ".net.xml")));
        std::vector<double> beside;  // [m] where lanes go on
        int straight_on = 0;
        for (const world::LaneT& from : town.lanes)
            for (const world::Link& link : from.links) {
                if (from.kind != world::LaneKind::driving)
                    continue;
                const Eigen::Vector3d end = world::to_eigen(from.centre.back());
                const Eigen::Vector3d start = world::to_eigen(town.lanes[link.to()].centre.front());
                EXPECT_LT((end - start).norm(), 25) << "where roads part, netconvert ends them";
                EXPECT_NEAR(end.z(), 5, 0.01);
                beside.push_back(end.y());
                straight_on += std::abs(end.y() - start.y()) < 0.01 ? 1 : 0;
            }
        EXPECT_EQ(straight_on, 2) << name;
        std::sort(beside.begin(), beside.end());
        ASSERT_EQ(beside.size(), 3U) << name;
        EXPECT_NEAR(beside[1] - beside[0], 3.5, 0.01) << name;
        EXPECT_NEAR(beside[2] - beside[1], 3.5, 0.01) << name;
    }
}

TEST_F(DirectJunctions, CarryTraffic) {
    expect_traffic(write("parting.xodr", parting()), 4, 400);
}

TEST_F(DirectJunctions, OfRoadsThatAreNotThereAreRefused) {
    EXPECT_THAT(message({write("parting.xodr", parting("33")), "", false, false}),
                HasSubstr("parting.xodr:14: <connection>: linkedRoad=\"33\": no such road"));
}

}  // namespace
}  // namespace reprise::towns
