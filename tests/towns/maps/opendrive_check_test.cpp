#include "towns/maps/opendrive_check.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "towns/maps/opendrive.h"
#include "world/check.h"

namespace reprise::towns {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* lane = R"(<lane id="-1" type="driving"><width a="3"/></lane>)";

/// One road, an element a line; its planView begins in line 3.
std::string road() {
    return std::string(R"(<OpenDRIVE><header revMajor="1" revMinor="4"/>
<road id="7" length="50" junction="-1">
<planView>
<geometry s="0" x="1" y="2" hdg="0" length="20"><line/></geometry>
<geometry s="20" x="21" y="2" hdg="0" length="10"><arc curvature="0.1"/></geometry>
<geometry s="30" x="30" y="4" hdg="0" length="20"><spiral curvStart="0.1" curvEnd="0.01"/></geometry>
</planView>
<elevationProfile><elevation s="0" a="2" b="0" c="0" d="0"/></elevationProfile>
<lanes><laneOffset s="0" a="0.5" b="0" c="0" d="0"/>
<laneSection s="0"><right>
)") + lane +
           R"(
</right></laneSection></lanes>
<signals><signal id="a" s="10" t="-4" type="206"/></signals>
</road>
</OpenDRIVE>)";
}

/// What is said of the road with one text in place of another.
std::string refusal(const std::string& from, const std::string& to) {
    std::string xml = road();
    EXPECT_NE(xml.find(from), std::string::npos) << from;
    xml.replace(xml.find(from), from.size(), to);
    try {
        read_opendrive(xml, "m.xodr");
    } catch (const world::Error& error) {
        return error.what();
    }
    return "";
}

std::string times(int count, const std::string& text) {
    std::string all;
    for (int i = 0; i < count; ++i)
        all += text;
    return all;
}

TEST(OpenDriveCheck, TakesARoad) {
    EXPECT_EQ(refusal(lane, lane), "");
}

TEST(OpenDriveCheck, NamesTheElementWhoseNumberIsImpossible) {
    struct Case {
        const char* right;   ///< what the map says
        const char* name;    ///< of the attribute
        const char* before;  ///< of its value
        const char* place;   ///< that is named
    };

    const Case cases[] = {
        {R"(id="7" length="50")", "length", R"(id="7" length=)", "m.xodr:2: <road>: "},
        {R"(hdg="0" length="20")", "length", R"(hdg="0" length=)", "m.xodr:4: <geometry>: "},
        {R"(s="20" x="21")", "s", R"(x="21" s=)", "m.xodr:5: <geometry>: "},
        {R"(x="30")", "x", "x=", "m.xodr:6: <geometry>: "},
        {R"(y="4")", "y", "y=", "m.xodr:6: <geometry>: "},
        {R"(y="2" hdg="0")", "hdg", R"(y="2" hdg=)", "m.xodr:4: <geometry>: "},
        {R"(curvature="0.1")", "curvature", "curvature=", "m.xodr:5: <arc>: "},
        {R"(curvStart="0.1")", "curvStart", "curvStart=", "m.xodr:6: <spiral>: "},
        {R"(curvEnd="0.01")", "curvEnd", "curvEnd=", "m.xodr:6: <spiral>: "},
        {R"(s="0" a="2")", "a", R"(s="0" a=)", "m.xodr:8: <elevation>: "},
        {R"(s="0" a="0.5")", "a", R"(s="0" a=)", "m.xodr:9: <laneOffset>: "},
        {R"(<width a="3")", "a", "<width a=", "m.xodr:11: <width>: "},
        {R"(<width a="3")", "a", "<border a=", "m.xodr:11: <border>: "},
        {R"(s="10" t="-4")", "s", R"(t="-4" s=)", "m.xodr:13: <signal>: "},
        {R"(t="-4")", "t", "t=", "m.xodr:13: <signal>: "},
    };
    for (const Case& one : cases)
        for (const char* value : {"1e9", "-1e300", "1e999", "nan", "inf", "12m", "0x10"})
            EXPECT_THAT(refusal(one.right, fmt::format("{}\"{}\"", one.before, value)),
                        StartsWith(fmt::format(
                            "{}{}=\"{}\" is not a number up to ", one.place, one.name, value)));
    // As far as anybody ever drove.
    EXPECT_EQ(refusal(R"(hdg="0" length="20")", R"(hdg="-6.28" length="2e3")"), "");
}

TEST(OpenDriveCheck, SaysOnlyTheStartOfALongNumber) {
    EXPECT_EQ(
        refusal(R"(x="30")", "x=\"" + std::string(1'000'000, '9') + "\""),
        "m.xodr:6: <geometry>: x=\"" + std::string(40, '9') + "\" is not a number up to 100000000");
}

TEST(OpenDriveCheck, NamesTheSectionWithTooManyLanes) {
    EXPECT_EQ(refusal(lane, times(64, lane)), "");
    EXPECT_EQ(refusal(lane, times(65, lane)),
              "m.xodr:10: <laneSection>: of road '7' has 65 lanes; 64 at most are possible");
    EXPECT_THAT(
        refusal(lane, std::string(lane) + "</right><left>" + times(64, lane) + "</left><right>"),
        HasSubstr("has 65 lanes"));
}

TEST(OpenDriveCheck, NamesTheRoadWithWhichItIsTooMuch) {
    std::string roads;
    for (int i = 0; i < 10; ++i)
        roads += fmt::format(R"(
<road id="long {}" length="1e5"><lanes><laneSection><right>{}</right></laneSection></lanes></road>)",
                             i,
                             times(20, lane));
    // 20 lanes of 100 km each: five such roads make 10,000 km.
    EXPECT_EQ(refusal("\n</OpenDRIVE>", roads + "\n</OpenDRIVE>"),
              "m.xodr:19: <road>: 'long 4': with it, the lanes are longer than 10000 km together");
}

TEST(OpenDriveCheck, NamesTheGeometryThatIsOutOfPlace) {
    EXPECT_EQ(refusal(R"(x="30")", R"(x="190000")"), "");
    EXPECT_EQ(refusal(R"(x="30")", R"(x="290000")"),
              "m.xodr:6: <geometry>: lies so far away that the town would be wider than 200 km");
    EXPECT_THAT(refusal(R"(y="2")", R"(y="-9e7")"), StartsWith("m.xodr:4: <geometry>: lies so"));
}

TEST(OpenDriveCheck, NamesTheElementThatIsNestedTooDeep) {
    const std::string deep = times(2000, "<userData>\n") + times(2000, "</userData>");
    EXPECT_THAT(
        refusal(lane, deep + lane),
        ContainsRegex("m.xodr:[0-9]+: <userData>: elements are nested more than 1000 deep"));
}

}  // namespace
}  // namespace reprise::towns
