#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "towns/network/place.h"
#include "world/geometry2d.h"
#include "world/models/building_models.h"

namespace reprise::towns {
namespace {

using Eigen::Vector2d;
using test::own_town;
using world::PropKind;
using world::TownT;
using world::Vec3;

/// Town 2 as it would be with this place beside it.
TownT town_with(const Place& place) {
    Network network = own_town("town2").network;
    network.place = place_xml(place);
    return read_town(network);
}

std::vector<Vec3> rectangle(const Vec3& middle, double length, double width) {
    const double x = length / 2;
    const double y = width / 2;
    const Vec3& m = middle;
    return {Vec3(m.x() - x, m.y() - y, m.z()),
            Vec3(m.x() + x, m.y() - y, m.z()),
            Vec3(m.x() + x, m.y() + y, m.z()),
            Vec3(m.x() - x, m.y() + y, m.z())};
}

/// The middle of the largest building of the invented town: land that is free to use.
Vec3 free_land() {
    const TownT bare = town_with({});
    const auto largest = std::max_element(
        bare.buildings.begin(), bare.buildings.end(), [](const auto& p, const auto& q) {
            return p.length() * p.width() < q.length() * q.width();
        });
    return largest->centre();
}

/// A lane that has a derived head on a pole of its own beside it.
const world::SignalHeadT& some_head(const TownT& town) {
    return *std::find_if(town.heads.begin(), town.heads.end(), [](const auto& head) {
        return !head.for_walkers && head.arm == 0;
    });
}

Place::Head known_head(const TownT& town, const Vec3& foot) {
    const world::SignalHeadT& like = some_head(town);
    Place::Head known;
    known.program = town.signals[like.signals[0]].program;
    for (const std::uint32_t signal : like.signals)
        known.links.push_back(town.signals[signal].index);
    known.foot = foot;
    known.yaw = like.yaw;
    known.height = 4.25;
    known.arm = 1.5;
    return known;
}

TEST(PlaceScenery, KnownHeadsStandWhereTheSourceSays) {
    const TownT derived = town_with({});
    const world::SignalHeadT& like = some_head(derived);
    Place place;
    place.heads.push_back(known_head(derived, like.foot));
    const TownT town = town_with(place);
    EXPECT_EQ(town.heads.size(), derived.heads.size());
    const auto head = std::find_if(town.heads.begin(), town.heads.end(), [&](const auto& each) {
        return each.signals == like.signals;
    });
    ASSERT_NE(head, town.heads.end());
    EXPECT_EQ(head->height, 4.25);
    EXPECT_EQ(head->arm, 1.5);
    EXPECT_NEAR(head->foot.x(), like.foot.x(), 1e-3);
}

TEST(PlaceScenery, HeadsOnTheRoadAreNotBelieved) {
    const TownT derived = town_with({});
    const world::SignalHeadT& like = some_head(derived);
    const world::LaneT& lane = derived.lanes[derived.signals[like.signals[0]].lane];
    Place place;
    place.heads.push_back(known_head(derived, lane.centre.back()));
    EXPECT_EQ(town_with(place).heads, derived.heads);
}

TEST(PlaceScenery, KnownSignsTakeThePlaceOfDerivedOnes) {
    const TownT derived = town_with({});
    const auto limit = std::find_if(derived.props.begin(), derived.props.end(), [](const auto& p) {
        return p.kind() == PropKind::speed_limit_sign;
    });
    ASSERT_NE(limit, derived.props.end());
    Place place;
    world::Prop known = *limit;
    known.mutate_value(35);
    place.signs.push_back(known);
    const TownT town = town_with(place);
    std::vector<int> limits;
    int priorities = 0;
    for (const world::Prop& prop : town.props) {
        if (prop.kind() == PropKind::speed_limit_sign)
            limits.push_back(prop.value());
        if (prop.kind() == PropKind::stop_sign || prop.kind() == PropKind::yield_sign)
            ++priorities;
    }
    EXPECT_EQ(limits, std::vector<int>{35});
    EXPECT_GT(priorities, 0) << "of those the source says nothing";
}

TEST(PlaceScenery, DrawnBuildingsStandAloneAndLeaveTheLanesFree) {
    const TownT bare = town_with({});
    const auto lane = std::find_if(bare.lanes.begin(), bare.lanes.end(), [](const auto& each) {
        return each.kind == world::LaneKind::driving;
    });
    Place place;
    place.buildings.resize(2);
    place.buildings[0].outline = rectangle(free_land(), 12, 9);
    place.buildings[0].outline.pop_back();  // no model stands on a triangle
    std::reverse(place.buildings[0].outline.begin(), place.buildings[0].outline.end());
    place.buildings[0].height = 7;
    place.buildings[1].outline = rectangle(lane->centre[0], 12, 9);
    place.buildings[1].height = 7;
    const TownT town = town_with(place);
    EXPECT_TRUE(town.buildings.empty()) << "none is invented beside real ones";
    ASSERT_EQ(town.drawn_buildings.size(), 1U) << "the other stands on the road";
    EXPECT_GT(world::signed_area(world::in_plan(town.drawn_buildings[0].outline)), 0);
    EXPECT_GE(town.drawn_buildings[0].model, 1U);
}

TEST(PlaceScenery, RectanglesStandAsWholeModels) {
    Place place;
    place.buildings.resize(2);
    place.buildings[0].outline = rectangle(free_land(), 12, 9);
    place.buildings[0].height = 6.5;
    place.buildings[0].style = 7;
    place.buildings[0].model = 1 + *world::find_building_model("brick_house");
    place.buildings[1] = place.buildings[0];
    for (Vec3& corner : place.buildings[1].outline)
        corner.mutate_y(corner.y() - 14);
    place.buildings[1].model = 1 + *world::find_building_model("department_store");
    const TownT town = town_with(place);
    ASSERT_EQ(town.buildings.size(), 1U);
    const world::Building& house = town.buildings[0];
    EXPECT_NEAR((world::in_plan(house.centre()) - world::in_plan(free_land())).norm(), 0, 1e-3);
    EXPECT_NEAR(house.length() * house.width(), 12 * 9, 0.03) << "millimetres in the file";
    EXPECT_EQ(house.height(), 6.5) << "of the eaves";
    EXPECT_EQ(house.model(), place.buildings[0].model);
    EXPECT_EQ(house.style(), 7U);
    EXPECT_EQ(town.drawn_buildings.size(), 1U) << "far too small for a department store";
}

TEST(PlaceScenery, ParksAreParksAndPondsAreEmpty) {
    const Vec3 middle = free_land();
    Place place;
    place.plots.resize(2);
    place.plots[0].kind = world::PlotKind::park;
    place.plots[0].outline = rectangle(middle, 36, 30);
    place.plots[1].kind = world::PlotKind::water;
    place.plots[1].outline = rectangle(middle, 12, 12);
    const TownT town = town_with(place);
    const world::Loop park = world::in_plan(place.plots[0].outline);
    const world::Loop pond = world::in_plan(place.plots[1].outline);
    int trees = 0;
    for (const world::Tree& tree : town.trees) {
        trees += world::contains(park, world::in_plan(tree.position())) ? 1 : 0;
        EXPECT_FALSE(world::contains(pond, world::in_plan(tree.position())));
    }
    int benches = 0;
    for (const world::Prop& prop : town.props) {
        benches +=
            prop.kind() == PropKind::bench && world::contains(park, world::in_plan(prop.position()))
                ? 1
                : 0;
        EXPECT_FALSE(world::contains(pond, world::in_plan(prop.position())));
    }
    EXPECT_GE(trees, 3);
    EXPECT_GE(benches, 3);
    for (const world::Building& building : town.buildings)
        EXPECT_FALSE(world::contains(park, world::in_plan(building.centre())));
}

TEST(PlaceScenery, NoBuildingStandsWhereItIsToBeKeptClear) {
    Place place;
    place.keep_clear.push_back(rectangle(Vec3(100, 100, 0), 5000, 5000));
    EXPECT_TRUE(town_with(place).buildings.empty());
}

TEST(PlaceScenery, DistrictsDecideHowATownIsBuilt) {
    const auto share = [](const TownT& town, world::BuildingUse use) {
        double count = 0;
        for (const world::Building& b : town.buildings)
            count += world::building_models()[b.model() - 1].use == use ? 1 : 0;
        return count / static_cast<double>(town.buildings.size());
    };
    Place village;
    village.districts.push_back({"village", {}});
    Place centre;
    centre.districts.push_back({"centre", {}});
    EXPECT_GT(share(town_with(village), world::BuildingUse::house), 0.5);
    EXPECT_EQ(share(town_with(village), world::BuildingUse::tower), 0);
    EXPECT_LT(share(town_with(centre), world::BuildingUse::house), 0.1);
    EXPECT_GT(share(town_with(centre), world::BuildingUse::tower), 0.05);
}

/// A road of 200 m from west to east, and back.
Network two_way_road(bool left_hand) {
    const std::string side = left_hand ? "1.6" : "-1.6";
    const std::string other = left_hand ? "-1.6" : "1.6";
    const auto edge = [](const std::string& id, const std::string& shape) {
        return "<edge id=\"" + id + "\" from=\"" + (id == "out" ? "A" : "B") + "\" to=\"" +
               (id == "out" ? "B" : "A") + "\"><lane id=\"" + id +
               "_0\" index=\"0\" speed=\"13.89\" length=\"200\" shape=\"" + shape + "\"/></edge>";
    };
    return {"tiny",
            std::string("<net version=\"1.9\"") + (left_hand ? " lefthand=\"true\"" : "") + ">" +
                edge("out", "0," + side + " 200," + side) +
                edge("back", "200," + other + " 0," + other) +
                "<junction id=\"A\" type=\"dead_end\" x=\"0\" y=\"0\" shape=\"\"/>"
                "<junction id=\"B\" type=\"dead_end\" x=\"200\" y=\"0\" shape=\"\"/></net>",
            "",
            ""};
}

TEST(PlaceScenery, SignsStandOnTheSideWhereOneDrives) {
    for (const bool left_hand : {false, true}) {
        const TownT town = read_town(two_way_road(left_hand));
        int signs = 0;
        for (const world::Prop& prop : town.props) {
            if (prop.kind() != PropKind::speed_limit_sign)
                continue;
            ++signs;
            EXPECT_EQ(prop.value(), 50);
            const Vector2d left(-std::sin(prop.yaw()), std::cos(prop.yaw()));
            const double t = left.dot(world::in_plan(prop.position()));
            EXPECT_NEAR(t, left_hand ? 3.8 : -3.8, 0.1);
        }
        EXPECT_EQ(signs, 2) << "one at each entry";
    }
}

}  // namespace
}  // namespace reprise::towns
