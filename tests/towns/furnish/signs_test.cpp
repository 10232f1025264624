#include "towns/furnish/signs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/towns/sampled_town.h"
#include "world/frames.h"

namespace reprise::towns {
namespace {

using Eigen::Vector3d;
using test::AnyTown;
using world::LaneT;
using world::Prop;
using world::PropKind;
using world::TownT;

bool is_sign(const Prop& prop) {
    return prop.kind() <= PropKind::crossing_sign;
}

/// A sign as drivers see it: a disc across its way.
struct Plate {
    explicit Plate(const Prop& prop)
        : ahead(std::cos(prop.yaw()), std::sin(prop.yaw()), 0),
          middle(prop.position().x(),
                 prop.position().y(),
                 prop.position().z() + prop.height() - radius - 0.03) {}

    static constexpr double radius = 0.35;  // [m] as it is drawn, the mean of its shapes
    Vector3d ahead, middle;
};

/// How much of a plate another one covers. In [0, 1].
double covered(const Plate& seen, const Plate& before, const Vector3d& eye) {
    int hidden = 0, all = 0;
    const Vector3d left(-seen.ahead.y(), seen.ahead.x(), 0);
    for (double across = -1; across <= 1; across += 0.1)
        for (double up = -1; up <= 1; up += 0.1) {
            if (std::hypot(across, up) > 1)
                continue;
            ++all;
            const Vector3d ray =
                seen.middle + Plate::radius * (across * left + up * Vector3d::UnitZ()) - eye;
            const double reach = before.ahead.dot(before.middle - eye) / before.ahead.dot(ray);
            hidden += reach > 0 && reach < 1 &&
                      (eye + reach * ray - before.middle).norm() < Plate::radius;
        }
    return 1.0 * hidden / all;
}

/// Where drivers are who read a sign: on the lanes beside it, so far before it, 1.2 m high. Before
/// the lane's start they come straight on.
std::vector<Vector3d> eyes(const TownT& town, const Prop& sign, double before) {
    std::vector<Vector3d> found;
    const Vector3d foot = world::to_eigen(sign.position());
    for (const LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::driving)
            continue;
        const world::LaneProjection on = world::project(lane, foot);
        if (on.distance > 8 ||
            std::cos(world::point_at(lane, on.s).yaw - sign.yaw()) < std::cos(0.3))
            continue;
        const double s = on.s - before;
        const world::LanePoint at = world::point_at(lane, std::max(s, 0.0));
        found.push_back(at.position +
                        std::min(s, 0.0) * Vector3d(std::cos(at.yaw), std::sin(at.yaw), 0) +
                        Vector3d(0, 0, 1.2));
    }
    return found;
}

class AnySigns : public AnyTown {};

INSTANTIATE_TEST_SUITE_P(Towns, AnySigns, test::any_town(), test::short_name);

TEST_P(AnySigns, HideNoOtherSign) {
    std::vector<const Prop*> signs;
    for (const Prop& prop : town().props)
        if (is_sign(prop))
            signs.push_back(&prop);
    EXPECT_GT(signs.size(), 10U);
    for (const Prop* seen : signs)
        for (double before = 10; before <= 40; before += 5)
            for (const Vector3d& eye : eyes(town(), *seen, before))
                for (const Prop* other : signs)
                    if (other != seen &&
                        (world::to_eigen(other->position()) - eye).norm() < before + 5) {
                        EXPECT_LT(covered(Plate(*seen), Plate(*other), eye), 0.2)
                            << static_cast<int>(seen->kind()) << " at "
                            << world::to_eigen(seen->position()).transpose() << " by "
                            << static_cast<int>(other->kind()) << " from " << before << " m";
                    }
}

class OwnSigns : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Own, OwnSigns, ::testing::Values("town1", "town2"));

TEST_P(OwnSigns, SayTheLimitWhereItChangesAndNowhereElse) {
    const TownT& town = test::own_town(GetParam()).town;
    std::set<std::string> changed;
    std::map<std::string, double> limits;
    for (const LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::driving)
            continue;
        limits[lane.edge] = lane.speed_limit;
        for (const world::Link& link : lane.links)
            if (link.turn() != world::Turn::around &&
                std::abs(town.lanes[link.to()].speed_limit - lane.speed_limit) > 0.5)
                changed.insert(town.lanes[link.to()].edge);
    }
    std::map<std::string, int> signs;
    std::set<int> figures;
    for (const Prop& prop : town.props) {
        if (prop.kind() != PropKind::speed_limit_sign)
            continue;
        figures.insert(prop.value());
        const LaneT* road = nullptr;
        double nearest = 8;
        for (const LaneT& lane : town.lanes) {
            const auto on = world::project(lane, world::to_eigen(prop.position()));
            if (lane.kind == world::LaneKind::driving && on.distance < nearest && on.s < 15 &&
                std::cos(world::point_at(lane, on.s).yaw - prop.yaw()) > 0.9) {
                nearest = on.distance;
                road = &lane;
            }
        }
        ASSERT_NE(road, nullptr) << world::to_eigen(prop.position()).transpose();
        ++signs[road->edge];
        EXPECT_NEAR(prop.value(), road->speed_limit * 3.6, 0.1) << road->edge;
    }
    EXPECT_EQ(figures, (std::set{30, 50, 60}));
    EXPECT_LT(changed.size(), limits.size());
    for (const auto& [edge, limit] : limits)
        EXPECT_EQ(signs[edge], changed.contains(edge) ? 1 : 0) << edge;
}

TEST_P(OwnSigns, CrossingSignsStandWhereNobodyElseMakesDriversGiveWay) {
    const TownT& town = test::own_town(GetParam()).town;
    int crossings = 0;
    for (const Prop& prop : town.props) {
        if (prop.kind() != PropKind::crossing_sign)
            continue;
        ++crossings;
        for (const Prop& other : town.props)
            if (other.kind() == PropKind::stop_sign || other.kind() == PropKind::yield_sign) {
                EXPECT_GT(
                    (world::to_eigen(prop.position()) - world::to_eigen(other.position())).norm(),
                    8);
            }
    }
    EXPECT_GE(crossings, 4);
}

/// The shown_figure at the start of a road of 200 m from nowhere.
int shown_figure(double limit) {
    const TownT town = read_town(
        {"tiny",
         fmt::format("<net version=\"1.9\"><edge id=\"e\" from=\"A\" to=\"B\"><lane id=\"e_0\" "
                     "index=\"0\" speed=\"{}\" length=\"200\" shape=\"0,0 200,0\"/></edge>"
                     "<junction id=\"A\" type=\"dead_end\" x=\"0\" y=\"0\" shape=\"\"/>"
                     "<junction id=\"B\" type=\"dead_end\" x=\"200\" y=\"0\" shape=\"\"/></net>",
                     limit),
         "",
         ""});
    for (const Prop& prop : town.props)
        if (prop.kind() == PropKind::speed_limit_sign)
            return prop.value();
    return 0;
}

TEST(Signs, ShowNoHigherFigureThanTheLimit) {
    EXPECT_EQ(shown_figure(17.88), 64) << "40 miles an hour";
    EXPECT_EQ(shown_figure(11.18), 40) << "25 miles an hour";
    EXPECT_EQ(shown_figure(29.06), 104) << "65 miles an hour";
    // As km/h come out in networks.
    EXPECT_EQ(shown_figure(8.33), 30);
    EXPECT_EQ(shown_figure(8.3), 30);
    EXPECT_EQ(shown_figure(13.89), 50);
    EXPECT_EQ(shown_figure(13.9), 50);
    EXPECT_EQ(shown_figure(33.33), 120);
}

}  // namespace
}  // namespace reprise::towns
