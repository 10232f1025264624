#include "render/shade/streak.h"

#include <gtest/gtest.h>

namespace reprise::render {
namespace {

/// The middle of a picture that is evenly grey, with a streak over it.
float under_streak(float behind, float light, float lit) {
    Frame frame;
    frame.width = frame.height = 9;
    frame.colors.assign(81, Color::Constant(behind));
    const std::vector<Hit> hits(81);
    draw_streak({{4.5, 3, 2}, {4.5, 6, 2}, 1, 0.8F, lit}, Color::Constant(light), hits, frame);
    return frame.colors[frame.index(4, 4)].x();
}

TEST(Streak, GoesNoFartherThanTheGround) {
    Frame frame;
    frame.width = 9;
    frame.height = 40;
    frame.colors.assign(360, Color::Zero());
    std::vector<Hit> hits(frame.colors.size());
    for (Hit& hit : hits) {
        hit.instance = 0;
        hit.distance = 1;
    }
    // As one looks down on it: from 0.8 m ahead to 1.2 m, through what lies 1 m ahead.
    draw_streak({{4.5, 5, 0.8}, {4.5, 35, 1.2}, 1, 0.8F, 0}, Color::Ones(), hits, frame);
    const auto at = [&](int y) { return frame.colors[frame.index(4, y)].x(); };
    EXPECT_GT(at(8), 0.1F);
    EXPECT_GT(at(20), 0.1F);
    EXPECT_EQ(at(26), 0.0F);
    EXPECT_EQ(at(34), 0.0F);
}

TEST(Streak, ByDayIsDarkBeforeABrightSky) {
    EXPECT_LT(under_streak(0.5F, 0.1F, 0), 0.3F);
    EXPECT_GT(under_streak(0.1F, 0.5F, 0), 0.3F);
}

TEST(Streak, ByNightIsNotDarkBeforeWhatLampsLight) {
    EXPECT_GT(under_streak(0.5F, 0.1F, 1.25F), 0.52F);
    EXPECT_GT(under_streak(0.01F, 0.1F, 1.25F), 0.05F) << "and has its own light";
    EXPECT_LT(under_streak(5.0F, 0.1F, 1.25F), 2.5F) << "a lamp behind it is hidden";
}

}  // namespace
}  // namespace reprise::render
