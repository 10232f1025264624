#include "towns/network/mended_lanes.h"

#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/traffic/stage.h"
#include "towns/network/network_xml.h"

namespace reprise::towns {
namespace {

/// A network of one road, with these lanes.
class OneRoad {
  public:
    explicit OneRoad(const std::string& lanes, const std::string& function = "") {
        const std::string said = "<net><edge id=\"r\"" +
                                 (function.empty() ? "" : " function=\"" + function + "\"") + ">" +
                                 lanes + "</edge></net>";
        document_.load_string(said.c_str());
        mended = mend_lanes(document_.child("net"));
    }

    std::string of_lane(int index, const char* attribute) const {
        pugi::xml_node lane = document_.child("net").child("edge").child("lane");
        for (int i = 0; i < index; ++i)
            lane = lane.next_sibling("lane");
        return lane.attribute(attribute).value();
    }

    MendedLanes mended;

  private:
    pugi::xml_document document_;
};

std::string lane(const std::string& shape, double length, const std::string& more = "") {
    return "<lane id=\"r_0\" index=\"0\" speed=\"13.89\" length=\"" + std::to_string(length) +
           "\" shape=\"" + shape + "\" " + more + "/>";
}

TEST(MendedLanes, ALineThatRunsBackOverItselfLosesThePoint) {
    // As netconvert wrote it for Town04 (0.1 m back), for acosta (its first 9 m), and at an end.
    const OneRoad step(lane("0,0,1 60,0,1 59.9,0,1 100,0,1", 100.2));
    EXPECT_EQ(step.of_lane(0, "shape"), "0,0,1 59.9,0,1 100,0,1");
    const OneRoad start(
        lane("983.06,867.20 985.44,875.94 984.69,873.25 981.69,870.63 856.68,917.85", 149.5));
    EXPECT_EQ(start.of_lane(0, "shape"), "983.06,867.20 984.69,873.25 981.69,870.63 856.68,917.85");
    const OneRoad end(lane("0,0 89.5,0 86.5,1.5", 92.8));
    EXPECT_EQ(end.of_lane(0, "shape"), "0,0 86.5,1.5");
    for (const OneRoad* road : {&step, &start, &end})
        EXPECT_EQ(road->mended.folds, 1U);
}

TEST(MendedLanes, AFoldBehindAPointThatIsThereTwiceIsOneAsWell) {
    const OneRoad road(lane("0,0 60,0 60,0 59,0 100,0", 102));
    EXPECT_EQ(road.mended.folds, 1U);
    EXPECT_EQ(road.of_lane(0, "shape"), "0,0 59,0 100,0");
}

TEST(MendedLanes, HairpinsStayAsTheyWereDrawn) {
    for (const char* shape : {"0,0 100,0 20,20",              // a V of two long legs
                              "0,0 50,0 54,2 54,5 50,7 0,7",  // a bend in several steps
                              "0,0 50,0 50,5 0,5"}) {         // two corners
        const OneRoad road(lane(shape, 1));
        EXPECT_EQ(road.mended.folds, 0U) << shape;
        EXPECT_EQ(road.of_lane(0, "shape"), shape);
    }
    const OneRoad turnaround(lane("0,0 4,1.5 0,2", 8), "internal");
    EXPECT_EQ(turnaround.mended.folds, 0U) << "within a junction one may turn around";
}

TEST(MendedLanes, ARoadHasTheLengthThatItIsDrawnWith) {
    const OneRoad road(lane("0,0 155,0", 92) + lane("0,3 155,3", 92));
    EXPECT_EQ(road.mended.lengths, 1U);
    for (const int index : {0, 1})
        EXPECT_EQ(road.of_lane(index, "length"), "155.00");
    const OneRoad shorter(lane("0,0 60,0", 92));
    EXPECT_EQ(shorter.of_lane(0, "length"), "60.00");
}

TEST(MendedLanes, LanesOfABendShareTheirMiddlesLength) {
    const OneRoad bend(lane("0,0 40,0", 50) + lane("0,3 60,3", 50));
    EXPECT_EQ(bend.mended.lengths, 0U);
    const OneRoad paired(lane("0,0 155,0\"><neigh lane=\"s_0", 92));
    EXPECT_EQ(paired.mended.lengths, 0U) << "the opposite lane has 92 m as well";
    const OneRoad inside(lane("0,0 20,0", 9), "internal");
    EXPECT_EQ(inside.mended.lengths, 0U);
}

TEST(MendedLanes, ALaneOfNoWidthIsClosed) {
    const OneRoad road(lane("0,0 100,0", 100, R"(width="0.00" allow="emergency authority")") +
                       lane("0,3 100,3", 100, R"(width="3.20")"));
    EXPECT_EQ(road.mended.closed, 1U);
    EXPECT_EQ(road.of_lane(0, "width"), "0.10");
    EXPECT_EQ(road.of_lane(0, "allow"), "");
    EXPECT_EQ(road.of_lane(0, "disallow"), "all");
    EXPECT_EQ(road.of_lane(1, "width"), "3.20");
}

TEST(MendedLanes, OurOwnTownsAreSound) {
    for (const char* name : {"town1", "town2"}) {
        const std::string own = test::own_town(name).network.xml;
        pugi::xml_document document;
        ASSERT_TRUE(document.load_buffer(own.data(), own.size()));
        const MendedLanes mended = mend_lanes(document.child("net"));
        EXPECT_EQ(mended.folds + mended.lengths + mended.closed, 0U) << name;
    }
}

}  // namespace
}  // namespace reprise::towns
