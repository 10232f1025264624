#include "towns/maps/reference_line.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <pugixml.hpp>

namespace reprise::towns {
namespace {

constexpr double pi = std::numbers::pi;

ReferenceLine line_of(const std::string& geometries) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(("<planView>" + geometries + "</planView>").c_str()));
    return ReferenceLine(document.child("planView"));
}

void expect_pose(const RoadPose& pose, double x, double y, double heading) {
    EXPECT_NEAR(pose.position.x(), x, 1e-6);
    EXPECT_NEAR(pose.position.y(), y, 1e-6);
    EXPECT_NEAR(pose.heading, heading, 1e-9);
}

TEST(ReferenceLine, FollowsALineThenAQuarterCircle) {
    const ReferenceLine line = line_of(
        "<geometry s='0' x='10' y='20' hdg='0' length='5'><line/></geometry>"
        "<geometry s='5' x='15' y='20' hdg='0' length='15.707963267948966'>"
        "<arc curvature='0.1'/></geometry>");
    expect_pose(line.at(2), 12, 20, 0);
    expect_pose(line.at(5 + 5 * pi), 25, 30, pi / 2);
    expect_pose(
        line.at(5 + 2.5 * pi), 15 + 10 * std::sin(pi / 4), 30 - 10 * std::cos(pi / 4), pi / 4);
    expect_pose(line.at(-3), 10, 20, 0);
    expect_pose(line.at(1000), 25, 30, pi / 2);
}

TEST(ReferenceLine, AClothoidTurnsAsItsCurvatureGrows) {
    const ReferenceLine line = line_of(
        "<geometry s='0' x='0' y='0' hdg='0' length='20'>"
        "<spiral curvStart='0' curvEnd='0.1'/></geometry>");
    // The other way: many small straight steps.
    double x = 0, y = 0;
    constexpr int steps = 200'000;
    for (int i = 0; i < steps; ++i) {
        const double s = 20 * (i + 0.5) / steps;
        x += 20.0 / steps * std::cos(0.0025 * s * s);
        y += 20.0 / steps * std::sin(0.0025 * s * s);
    }
    expect_pose(line.at(20), x, y, 1);
}

TEST(ReferenceLine, AClothoidOfOneCurvatureIsAnArc) {
    const std::string start = "<geometry s='0' x='1' y='2' hdg='0.7' length='30'>";
    const ReferenceLine spiral =
        line_of(start + "<spiral curvStart='-0.05' curvEnd='-0.05'/></geometry>");
    const ReferenceLine arc = line_of(start + "<arc curvature='-0.05'/></geometry>");
    for (const double s : {1.0, 13.0, 30.0}) {
        const RoadPose expected = arc.at(s);
        expect_pose(spiral.at(s), expected.position.x(), expected.position.y(), expected.heading);
    }
}

TEST(ReferenceLine, PolynomialsAreSeenFromTheirStart) {
    // v = u^2 / 20, turned by 90 degrees: u grows to the north, v to the west.
    const std::string start = "<geometry s='0' x='5' y='0' hdg='1.5707963267948966' length='8'>";
    const ReferenceLine by_length =
        line_of(start +
                "<paramPoly3 aU='0' bU='1' cU='0' dU='0' aV='0' bV='0' cV='0.05' dV='0' "
                "pRange='arcLength'/></geometry>");
    expect_pose(by_length.at(4), 5 - 0.8, 4, pi / 2 + std::atan(0.4));
    const ReferenceLine normalised =
        line_of(start +
                "<paramPoly3 aU='0' bU='8' cU='0' dU='0' aV='0' bV='0' cV='3.2' dV='0' "
                "pRange='normalized'/></geometry>");
    expect_pose(normalised.at(4), 5 - 0.8, 4, pi / 2 + std::atan(0.4));
}

TEST(ReferenceLine, ACubicIsMeasuredAlongTheCurve) {
    // v = u: the place at s is s / sqrt(2) both ways.
    const ReferenceLine line = line_of(
        "<geometry s='0' x='0' y='0' hdg='0' length='10'><poly3 a='0' b='1' c='0' "
        "d='0'/></geometry>");
    expect_pose(line.at(4), 4 / std::sqrt(2.0), 4 / std::sqrt(2.0), pi / 4);
    // v = u^2 / 10: the length of the curve from 0 to u is known.
    const ReferenceLine bent = line_of(
        "<geometry s='0' x='0' y='0' hdg='0' length='10'><poly3 a='0' b='0' c='0.1' "
        "d='0'/></geometry>");
    const double u = bent.at(6).position.x();
    const double slope = 0.2 * u;
    const double length = (slope * std::hypot(1.0, slope) + std::asinh(slope)) / 0.4;
    EXPECT_NEAR(length, 6, 1e-4);
    EXPECT_NEAR(bent.at(6).position.y(), 0.1 * u * u, 1e-9);
}

TEST(ReferenceLine, WithoutPiecesLiesAtTheOrigin) {
    expect_pose(line_of("").at(7), 0, 0, 0);
}

}  // namespace
}  // namespace reprise::towns
