#include "ground/mesh/splinters.h"

#include <gtest/gtest.h>

namespace reprise {
namespace {

using ground::Area;
using world::Loop;

Loop rectangle_of(double x, double y, double length, double width) {
    return {{x, y}, {x + length, y}, {x + length, y + width}, {x, y + width}};
}

Area filled(const Loop& loop) {
    Area area;
    area.add(loop);
    return area;
}

const ground::SurfaceHeight level;
const ground::SurfaceHeight upstairs({{world::Vec3(0, 0, 3), world::Vec3(50, 50, 3)}});

ground::Patch patch(const Area& area,
                    bool at_crossing = false,
                    const ground::SurfaceHeight& height = level) {
    const std::vector<Loop> borders = area.borders();
    return {&area, &height, borders, world::box_around(borders[0]), at_crossing};
}

using Found = std::vector<bool>;

TEST(Splinters, JoinWhatTheyTouchOnTheirLevel) {
    const Area small = filled(rectangle_of(0, 0, 1, 1));
    const Area beside = filled(rectangle_of(1.04, 0, 4, 1));
    const Area apart = filled(rectangle_of(1.06, 0, 4, 1));
    EXPECT_EQ(ground::find_splinters({patch(small)}), Found({true}));
    EXPECT_EQ(ground::find_splinters({patch(small), patch(beside)}), Found({false, false}));
    EXPECT_EQ(ground::find_splinters({patch(small), patch(apart)}), Found({true, false}));
    EXPECT_EQ(ground::find_splinters({patch(small), patch(beside, false, upstairs)}),
              Found({true, false}));
}

TEST(Splinters, AreWholeIslands) {
    const Area first = filled(rectangle_of(0, 0, 1.9, 1));
    const Area second = filled(rectangle_of(1.9, 0, 1.9, 1));
    const Area third = filled(rectangle_of(3.8, 0, 1.9, 1));
    EXPECT_EQ(ground::find_splinters({patch(third), patch(first)}), Found({true, true}));
    EXPECT_EQ(ground::find_splinters({patch(third), patch(first), patch(second)}),
              Found({false, false, false}));
    EXPECT_EQ(ground::find_splinters({patch(second), patch(second), patch(second)}),
              Found({true, true, true}))
        << "drawn thrice is not thrice as large";
}

TEST(Splinters, AreNarrowUnlessLong) {
    const Area narrow = filled(rectangle_of(0, 0, 9, 0.5));
    const Area wider = filled(rectangle_of(0, 0, 9, 0.7));
    const Area longer = filled(rectangle_of(0, 0, 30, 0.4));
    EXPECT_EQ(ground::find_splinters({patch(narrow)}), Found({true}));
    EXPECT_EQ(ground::find_splinters({patch(wider)}), Found({false}));
    EXPECT_EQ(ground::find_splinters({patch(longer)}), Found({false}));
}

TEST(Splinters, AreNotRefugesOnCrossings) {
    const Area refuge = filled(rectangle_of(0, 0, 1.5, 1));
    const Area corner = filled(rectangle_of(0, 0, 0.9, 1));
    EXPECT_EQ(ground::find_splinters({patch(refuge), patch(refuge, true)}), Found({false, false}));
    EXPECT_EQ(ground::find_splinters({patch(corner, true)}), Found({true}));
}

TEST(Splinters, InAHoleOfASidewalkAreNotJoinedToIt) {
    Area ring = filled(rectangle_of(0, 0, 8, 8));
    ring.subtract(filled(rectangle_of(2, 2, 4, 4)));
    const Area inside = filled(rectangle_of(3, 3, 1, 1));
    const Area at_its_edge = filled(rectangle_of(2.03, 3, 1, 1));
    EXPECT_EQ(ground::find_splinters({patch(ring), patch(inside)}), Found({false, true}));
    EXPECT_EQ(ground::find_splinters({patch(ring), patch(at_its_edge)}), Found({false, false}));
}

}  // namespace
}  // namespace reprise
