#include "towns/maps/opendrive.h"

#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "world/check.h"

namespace reprise::towns {
namespace {

using ::testing::HasSubstr;
using Kind = RoadSignal::Kind;

/// One road, north along x = 100, rising by 5 %, with these signals and this rule.
std::string map_with(const std::string& signals, const std::string& rule = "RHT") {
    return R"(<?xml version="1.0"?>
<OpenDRIVE><header revMajor="1" revMinor="4"/>
<road id="7" length="50" junction="-1" rule=")" +
           rule + R"(">
<type s="0" type="town"><speed max="25" unit="mph"/></type>
<type s="30" type="town"><speed max="60" unit="km/h"/></type>
<planView><geometry s="0" x="100" y="0" hdg="1.5707963267948966" length="50"><line/></geometry></planView>
<elevationProfile><elevation s="0" a="2" b="0.05" c="0" d="0"/></elevationProfile>
<lanes>
<laneSection s="0"><right>
<lane id="-1" type="driving"><link/><width a="3"/><roadMark/></lane>
<lane id="-2" type="driving"><width a="3"/><speed sOffset="0" max="9"/></lane>
<lane id="-3" type="sidewalk"><width a="2"/></lane></right></laneSection>
<laneSection s="30"><left><lane id="1" type="driving"><width a="3"/></lane></left></laneSection>
</lanes><signals>)" +
           signals + "</signals></road></OpenDRIVE>";
}

TEST(OpenDrive, RoadLimitsAreWrittenIntoLanesWithoutOne) {
    const OpenDrive map = read_opendrive(map_with(""), "m.xodr");
    EXPECT_EQ(map.version, "1.4");
    EXPECT_EQ(map.limits_set, 2);
    EXPECT_THAT(map.prepared,
                HasSubstr("<roadMark/><speed sOffset=\"0\" max=\"11.1760\" unit=\"m/s\"/></lane>"));
    EXPECT_THAT(map.prepared, HasSubstr("<speed sOffset=\"0\" max=\"16.6667\" unit=\"m/s\"/>"));
    EXPECT_THAT(map.prepared, HasSubstr("type=\"sidewalk\"><width a=\"2\"/></lane>"));
    // Nothing more is to be done in what came out.
    EXPECT_EQ(read_opendrive(map.prepared, "m.xodr").limits_set, 0);
}

TEST(OpenDrive, ALimitThatChangesWithinALaneSectionIsKept) {
    std::string xml = map_with("");
    const std::string second = "<type s=\"30\"", moved = "<type s=\"12.5\"";
    xml.replace(xml.find(second), second.size(), moved);
    EXPECT_THAT(read_opendrive(xml, "m.xodr").prepared,
                HasSubstr("<roadMark/><speed sOffset=\"0\" max=\"11.1760\" unit=\"m/s\"/>"
                          "<speed sOffset=\"12.5\" max=\"16.6667\" unit=\"m/s\"/></lane>"));
}

TEST(OpenDrive, SuperelevationIsCountedAndMovesNoSign) {
    const std::string sign = "<signal id='a' s='40' t='-4' type='206'/>";
    std::string xml = map_with(sign);
    const std::string after = "</elevationProfile>";
    xml.insert(
        xml.find(after) + after.size(),
        "<lateralProfile><superelevation s='0' a='0.2' b='0' c='0' d='0'/></lateralProfile>");
    const OpenDrive banked = read_opendrive(xml, "m.xodr");
    const OpenDrive level = read_opendrive(map_with(sign), "m.xodr");
    EXPECT_EQ(banked.banked, 1);
    EXPECT_EQ(level.banked, 0);
    ASSERT_EQ(banked.signals.size(), 1U);
    EXPECT_EQ(banked.signals[0].foot.z(), level.signals.at(0).foot.z())
        << "the town's road is level there";
}

TEST(OpenDrive, SignalsStandBesideTheReferenceLine) {
    const OpenDrive map = read_opendrive(
        map_with("<signal id='a' name='Signal_3Light' s='40' t='-4' zOffset='5' hOffset='0.1' "
                 "orientation='-' dynamic='yes' type='1000001' height='1'/>"),
        "m.xodr");
    ASSERT_EQ(map.signals.size(), 1U);
    const RoadSignal& light = map.signals[0];
    EXPECT_EQ(light.kind, Kind::light);
    EXPECT_NEAR(light.foot.x(), 104, 1e-9) << "to the right of north is east";
    EXPECT_NEAR(light.foot.y(), 40, 1e-9);
    EXPECT_NEAR(light.foot.z(), 4, 1e-9);
    EXPECT_NEAR(light.heading, std::numbers::pi / 2 + 0.1, 1e-9);
    EXPECT_TRUE(light.against);
    EXPECT_EQ(light.bottom, 5);
    EXPECT_EQ(light.height, 1);
}

TEST(OpenDrive, KindsAreKnownByNumberCountryOrName) {
    struct Case {
        const char* attributes;
        Kind kind;
        double limit;
    };

    const Case cases[] = {
        {"type='206'", Kind::stop, 0},
        {"name='Sign_Stop'", Kind::stop, 0},
        {"type='R1-1' country='US'", Kind::stop, 0},
        {"type='205'", Kind::yield, 0},
        {"type='274' value='30'", Kind::speed_limit, 30},
        {"type='274' subtype='50' value='-1'", Kind::speed_limit, 50},
        {"type='274' value='10' unit='m/s'", Kind::speed_limit, 36},
        {"type='R2-1' value='25' country='US'", Kind::speed_limit, 40.2336},
        {"type='274.1' value='30' unit='km/h' name='zone'", Kind::speed_limit, 30},
        {"type='274.1' subtype='20' value='-1'", Kind::speed_limit, 20},
        {"type='274' subtype='56' value='-1'", Kind::speed_limit, 60},  // before 2017
        {"name='Speed_60' value='-1'", Kind::speed_limit, 60},
        {"type='-1' name='Sign_SpeedLimit_30'", Kind::speed_limit, 30},
        {"type='-1' name='Speed_30_mph'", Kind::speed_limit, 48.28032},
        {"name='traffic light' dynamic='yes'", Kind::light, 0},
    };
    for (const Case& one : cases) {
        const std::string signal =
            std::string("<signal id='a' s='1' t='1' ") + one.attributes + "/>";
        const OpenDrive map = read_opendrive(map_with(signal), "m.xodr");
        ASSERT_EQ(map.signals.size(), 1U) << one.attributes;
        EXPECT_EQ(map.signals[0].kind, one.kind) << one.attributes;
        EXPECT_NEAR(map.signals[0].limit_kmh, one.limit, 1e-9) << one.attributes;
    }
}

TEST(OpenDrive, OtherSignsAreCounted) {
    const OpenDrive map = read_opendrive(
        map_with("<signal id='a' s='1' t='1' type='306'/><signal id='b' s='1' t='1' type='274'/>"
                 "<signal id='c' s='1' t='1' type='294' dynamic='no'/>"),
        "m.xodr");
    EXPECT_TRUE(map.signals.empty());
    EXPECT_EQ(map.other_signs, 3);
}

TEST(OpenDrive, WhatOnlyHasSpeedInItsNameIsNoLimit) {
    for (const char* other : {"name='SpeedBump_Sign_5' type='112'",
                              "name='SpeedBump_Sign_5' type='-1'",
                              "name='EndOfSpeedLimit50' type='278' value='50' unit='km/h'",
                              "name='Speed_50' type='278' value='50'",
                              "name='AdvisorySpeed_25' type='W13-1' value='25' country='US'",
                              "name='Speed_Camera' type='-1' value='50'"}) {
        const OpenDrive map = read_opendrive(
            map_with(std::string("<signal id='a' s='1' t='1' ") + other + "/>"), "m.xodr");
        EXPECT_TRUE(map.signals.empty()) << other;
        EXPECT_EQ(map.other_signs, 1) << other;
    }
}

TEST(OpenDrive, TheRuleOfTheRoadIsRead) {
    EXPECT_FALSE(read_opendrive(map_with(""), "m.xodr").left_hand);
    EXPECT_TRUE(read_opendrive(map_with("", "LHT"), "m.xodr").left_hand);
}

TEST(OpenDrive, MistakesNameTheLine) {
    const auto said = [](const std::string& xml) -> std::string {
        try {
            read_opendrive(xml, "m.xodr");
        } catch (const world::Error& error) {
            return error.what();
        }
        return "nothing";
    };
    EXPECT_THAT(said("<OpenDRIVE>\n<road"), HasSubstr("m.xodr:2: is not an OpenDRIVE map"));
    EXPECT_EQ(said("\n<OpenDRIVE/>"), "m.xodr:2: has no <road>");
}

}  // namespace
}  // namespace reprise::towns
