#include "towns/network/place.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "world/check.h"
#include "world/models/building_models.h"

namespace reprise::towns {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* all_kinds = R"(<?xml version="1.0"?>
<!-- a town of our own -->
<place>
  <head program="J&quot;3&amp;4" links="0 1" x="1.5" y="-2" z="0.25" yaw="90" height="5.2" arm="3"/>
  <sign kind="speed_limit" value="30" x="1" y="2" yaw="-45" height="2.4" width="0.6"/>
  <sign kind="stop" x="7" y="8" z="1" height="2.4"/>
  <plot kind="park" shape="0,0 50,0 50,40 0,40"/>
  <building shape="0,0 12,0 12,9" z="2.5" height="9" model="brick_house" style="77"/>
  <building shape="0,0,1 12,0,2 12,9,3" height="4"/>
  <district style="old" shape="0,0 9,0 9,9"/>
  <district style="village"/>
  <keep_clear shape="0,0 1,0 1,1"/>
</place>
)";

TEST(Place, ReadsEveryKind) {
    const Place place = read_place(all_kinds, "x.place.xml");
    ASSERT_EQ(place.heads.size(), 1U);
    EXPECT_EQ(place.heads[0].program, "J\"3&4");
    EXPECT_EQ(place.heads[0].links, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(place.heads[0].foot, world::Vec3(1.5, -2, 0.25));
    EXPECT_DOUBLE_EQ(place.heads[0].yaw, 3.14159265358979323846 / 2);
    EXPECT_EQ(place.heads[0].arm, 3);
    ASSERT_EQ(place.signs.size(), 2U);
    EXPECT_EQ(place.signs[0].kind(), world::PropKind::speed_limit_sign);
    EXPECT_EQ(place.signs[0].value(), 30);
    EXPECT_EQ(place.signs[0].width(), 0.6);
    EXPECT_EQ(place.signs[1].kind(), world::PropKind::stop_sign);
    ASSERT_EQ(place.plots.size(), 1U);
    EXPECT_EQ(place.plots[0].kind, world::PlotKind::park);
    EXPECT_EQ(place.plots[0].outline.size(), 4U);
    ASSERT_EQ(place.buildings.size(), 2U);
    EXPECT_EQ(place.buildings[0].outline[1], world::Vec3(12, 0, 2.5))
        << "z is added to every point";
    EXPECT_EQ(place.buildings[0].model, *world::find_building_model("brick_house") + 1);
    EXPECT_EQ(place.buildings[0].style, 77U);
    EXPECT_EQ(place.buildings[1].outline[1].z(), 2);
    ASSERT_EQ(place.districts.size(), 2U);
    EXPECT_EQ(place.districts[0].style, "old");
    EXPECT_TRUE(place.districts[1].outline.empty());
    EXPECT_EQ(place.keep_clear.size(), 1U);
}

TEST(Place, WritesWhatItReadsAgainWithTheSameBytes) {
    const Place place = read_place(all_kinds, "x.place.xml");
    const std::string written = place_xml(place);
    const Place again = read_place(written, "again.place.xml");
    EXPECT_EQ(place_xml(again), written);
    EXPECT_EQ(again.heads[0].program, place.heads[0].program);
    EXPECT_EQ(again.signs, place.signs);
    EXPECT_EQ(again.plots, place.plots);
    EXPECT_EQ(again.buildings, place.buildings);
    EXPECT_EQ(again.keep_clear, place.keep_clear);
    EXPECT_EQ(place_xml(read_place(place_xml(Place()), "none.place.xml")), "<place />\n");
}

TEST(Place, RoundsToMillimetres) {
    Place place;
    place.plots.emplace_back();
    place.plots[0].outline = {{-0.0001, 1.0 / 3, 0}, {1e5 + 0.12349, 2, -1e-9}, {3, 4.1, 0}};
    EXPECT_THAT(place_xml(place), HasSubstr("shape=\"0,0.333 100000.123,2 3,4.1\""));
}

TEST(Place, TellsEveryMistakeWithItsLine) {
    struct Case {
        const char* xml;
        const char* said;
    };

    const Case cases[] = {
        {"", "t.place.xml:1: expected <place>"},
        {"<net/>", "t.place.xml:1: expected <place>: found <net>"},
        {"<place>\n<sign kind=\n", "t.place.xml:2: expected <place>"},
        {"<place>\n<sing/></place>", "t.place.xml:2: <sing>: is unknown (did you mean 'sign'?)"},
        {"<place>\n<sign kind='stpo'/></place>", "did you mean 'stop'?"},
        {"<place><sign kind='stop' x='east'/></place>", "x=\"east\" is not a number"},
        {"<place><sign kind='speed_limit' value='-3'/></place>", "'-3' is not a whole number"},
        {"<place><sign kind='speed_limit' value='70000'/></place>", "expected km/h"},
        {"<place><plot kind='park' shape='0,0 1,1'/></place>", "three points"},
        {"<place><plot kind='park' shape='0,0 1,x 2,2'/></place>", "'1,x' in its shape is not"},
        {"<place><plot kind='prak' shape='0,0 1,0 2,2'/></place>", "did you mean 'park'?"},
        {"<place><building shape='0,0 1,0 2,2'/></place>", "height must be above 0"},
        {"<place><building shape='0,0 1,0 2,2' height='3' model='cotage'/></place>", "cottage"},
        {"<place><district style='brik'/></place>", "did you mean 'brick'?"},
        {"<place><head program='J'/></place>", "needs a program and its links"},
        {"<place><head program='J' links='1 b'/></place>", "'b' is not a whole number"},
    };
    for (const Case& one : cases) {
        try {
            read_place(one.xml, "t.place.xml");
            ADD_FAILURE() << one.xml;
        } catch (const world::Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(one.said));
            EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        }
    }
}

}  // namespace
}  // namespace reprise::towns
