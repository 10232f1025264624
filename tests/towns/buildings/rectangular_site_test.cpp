#include "towns/buildings/rectangular_site.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace reprise::towns {
namespace {

using Eigen::Vector2d;

const world::BuildingModel& model(std::string_view name) {
    return world::building_models()[*world::find_building_model(name)];
}

/// Beside a road from west to east along y = 0, whose sidewalks end at some 6 m.
world::Loop turned(const Vector2d& middle, double length, double width, double yaw) {
    return corners({middle, yaw, length, width});
}

/// Of the middle of the front, away from the building.
Vector2d front_of(const Footprint& f) {
    return f.centre + Vector2d(std::sin(f.yaw), -std::cos(f.yaw)) * f.width / 2;
}

TEST(RectangularSite, IsTheRectangleThatWasDrawn) {
    const Streets streets(test::straight_road());
    const auto site = rectangular_site(turned({100, 40}, 12, 9, 0.3), streets);
    ASSERT_TRUE(site);
    for (const Footprint& f : site->fronts) {
        EXPECT_NEAR((f.centre - Vector2d(100, 40)).norm(), 0, 1e-9);
        EXPECT_NEAR(f.length * f.width, 12 * 9, 1e-6);
        EXPECT_NEAR(std::remainder(f.yaw - 0.3, std::acos(0)), 0, 1e-9);
    }
}

TEST(RectangularSite, ANookIsAllowedAnAngleIsNot) {
    const Streets streets(test::straight_road());
    const auto with_nook = [&](double size) {
        return rectangular_site(
            {{0, 40}, {12, 40}, {12, 50 - size}, {12 - size, 50 - size}, {12 - size, 50}, {0, 50}},
            streets);
    };
    const auto nook = with_nook(2);
    ASSERT_TRUE(nook);
    EXPECT_NEAR(nook->fronts[0].length * nook->fronts[0].width, 120 - 4, 1e-6)
        << "as large as what was drawn, not as what is around it";
    EXPECT_FALSE(with_nook(5));
    EXPECT_FALSE(rectangular_site({{0, 40}, {20, 40}, {10, 55}}, streets));
    EXPECT_FALSE(rectangular_site({{0, 40}, {0, 40}, {0, 40}}, streets));
}

/// A corner that a sidewalk cut off (edge 6 m from the axis) is not put back.
TEST(RectangularSite, IsNoneWhereTheRectangleWouldStandOnASidewalk) {
    const Streets streets(test::straight_road());
    const auto cut_off = [&](double y) {
        return rectangular_site({{2, y}, {12, y}, {12, y + 10}, {0, y + 10}, {0, y + 2}}, streets);
    };
    EXPECT_TRUE(cut_off(6.2));
    EXPECT_FALSE(cut_off(5.8));
    EXPECT_FALSE(cut_off(2));
}

TEST(RectangularSite, DoorsAreAtTheStreet) {
    const Streets streets(test::straight_road());
    for (const double side : {-1.0, 1.0})
        for (const double yaw : {0.0, 1.2, 2.6, 4.0}) {
            const auto site = rectangular_site(turned({100, side * 25}, 11, 10, yaw), streets);
            ASSERT_TRUE(site);
            const auto f = fit(model("brick_house"), *site, streets);
            ASSERT_TRUE(f) << yaw;
            EXPECT_LT(std::abs(front_of(*f).y()), 25 - 3) << side << ' ' << yaw;
        }
    // The narrow side of a row is no front.
    const auto row = rectangular_site(turned({100, 30}, 10, 24, 0), streets);
    const auto f = fit(model("brick_terrace"), *row, streets);
    ASSERT_TRUE(f);
    EXPECT_NEAR(f->length, 24, 1e-6);
}

TEST(RectangularSite, ModelsStandWhereTheirSizesAllow) {
    const Streets streets(test::straight_road());
    const auto fits = [&](std::string_view name, double length, double width) {
        return fit(model(name),
                   *rectangular_site(turned({100, 60}, length, width, 0), streets),
                   streets)
            .has_value();
    };
    EXPECT_TRUE(fits("cottage", 10, 9));
    EXPECT_FALSE(fits("cottage", 4, 4));
    EXPECT_FALSE(fits("cottage", 30, 9));
    EXPECT_FALSE(fits("church", 10, 9));
    EXPECT_TRUE(fits("church", 26, 12));
}

TEST(RectangularSite, PorchesStayOffTheSidewalk) {
    const Streets streets(test::straight_road());
    const world::Loop near = turned({100, 11}, 12, 9, 0);  // its front at 6.5 m
    double kerb = 4.5;                                     // [m] outer edge of the sidewalk
    while (streets.walks.of(Vector2d(100, kerb)) <= 0)
        kerb += 0.05;
    ASSERT_LT(6.5 - kerb, 1.2) << "the porch would reach onto it";
    const auto site = rectangular_site(near, streets);
    const auto porch = fit(model("brick_house"), *site, streets);
    ASSERT_TRUE(porch);
    EXPECT_GT(front_of(*porch).y(), kerb + 1.15);
    EXPECT_NEAR(porch->centre.y() + porch->width / 2, 15.5, 1e-6) << "its back stays";
    const auto plain = fit(model("farmhouse"), *site, streets);
    ASSERT_TRUE(plain);
    EXPECT_NEAR(front_of(*plain).y(), 6.5, 1e-6);
}

}  // namespace
}  // namespace reprise::towns
