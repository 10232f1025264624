#include <map>

#include <gmock/gmock.h>

#include "ground/mesh/build_ground.h"
#include "render/look/look.h"
#include "render/shapes/street/plot_mesh.h"
#include "render/shapes/street/prop_mesh.h"
#include "render/shapes/street/signal_parts.h"
#include "tests/render/everything.h"
#include "tests/render/street.h"

namespace reprise {

namespace {

using render::Mesh;
using world::PropKind;
using world::SemanticClass;

constexpr int prop_kinds = static_cast<int>(PropKind::table) + 1;

/// Share of a mesh's triangles by class.
std::map<SemanticClass, int> classes_of(PropKind kind) {
    const Mesh mesh =
        prop_mesh(kind, render::size_of(test::all_props()[static_cast<std::size_t>(kind)]));
    std::map<SemanticClass, int> counts;
    for (const std::uint32_t tag : mesh.tags)
        ++counts[render::prop_class(tag)];
    return counts;
}

/// A road with one prop 6 m ahead of the camera at its own height.
world::SensorFrame seen(const world::Prop& prop, world::SensorKind kind, double height) {
    world::TownT town = test::straight_road(200);
    town.props = {prop};
    render::Sensors sensors(town);
    const world::SealedTick tick = test::tick_with({});
    world::SensorSpec spec = test::camera(kind, {94, -6, height});
    spec.fov = 0.25;
    return sensors.observe(tick.view(), {spec}, test::noon())[0];
}

world::Prop sign(PropKind kind, std::uint16_t value) {
    return {world::Vec3(100, -6, 0.15), 0, 0, 0, 2.5, 0, value, kind, 0};
}

int differing_bytes(const world::SensorFrame& one, const world::SensorFrame& other) {
    int count = 0;
    for (std::size_t i = 0; i < one.data.size(); ++i)
        count += one.data[i] != other.data[i];
    return count;
}

/// A signal with a head of its own beside the road.
world::TownT town_with_head() {
    world::TownT town = test::straight_road_with_signal(200);
    world::SignalHeadT head;
    head.signals = {0};
    head.foot = world::Vec3(100, -6, 0.15);
    head.height = 3;
    town.heads = {head};
    return town;
}

/// Mean of a channel over the head's case, when its signal shows this.
std::array<double, 3> head_colour(render::Sensors& sensors, world::SignalColor color) {
    world::SensorSpec spec = test::camera(world::SensorKind::rgb, {94, -6, 3.1});
    spec.fov = 0.2;
    const world::SealedTick tick = test::tick_with({}, {}, {color});
    const world::SensorFrame frame = sensors.observe(tick.view(), {spec}, test::noon())[0];
    return {test::mean(frame, 0, 60, 20, 100, 100),
            test::mean(frame, 1, 60, 20, 100, 100),
            test::mean(frame, 2, 60, 20, 100, 100)};
}

}  // namespace

TEST(Props, EveryKindIsOfItsClass) {
    const auto expect = [](PropKind kind, SemanticClass expected) {
        const auto counts = classes_of(kind);
        ASSERT_TRUE(counts.contains(expected)) << static_cast<int>(kind);
    };
    for (const PropKind kind : {PropKind::speed_limit_sign,
                                PropKind::stop_sign,
                                PropKind::yield_sign,
                                PropKind::crossing_sign})
        EXPECT_THAT(classes_of(kind),
                    testing::UnorderedElementsAre(
                        testing::Pair(SemanticClass::pole, testing::Gt(0)),
                        testing::Pair(SemanticClass::traffic_sign, testing::Gt(0))));
    expect(PropKind::street_light, SemanticClass::pole);
    expect(PropKind::pole, SemanticClass::pole);
    expect(PropKind::fence, SemanticClass::fence);
    expect(PropKind::wall, SemanticClass::wall);
    expect(PropKind::hedge, SemanticClass::vegetation);
    expect(PropKind::bench, SemanticClass::static_object);
    expect(PropKind::bin, SemanticClass::dynamic_object);
    expect(PropKind::fountain, SemanticClass::water);
}

TEST(Props, FillTheirSize) {
    for (int i = 0; i < prop_kinds; ++i) {
        const auto kind = static_cast<PropKind>(i);
        if (kind == PropKind::parked_vehicle)
            continue;
        const render::PropSize size =
            render::size_of(test::all_props()[static_cast<std::size_t>(i)]);
        const Mesh mesh = prop_mesh(kind, size);
        ASSERT_FALSE(mesh.triangles.empty()) << i;
        EXPECT_LT(mesh.triangles.size(), 6000U) << i;
        Eigen::AlignedBox3f box;
        for (const Eigen::Vector3f& vertex : mesh.vertices)
            box.extend(vertex);
        EXPECT_NEAR(box.max().z(), size.height, 0.45) << i;
        EXPECT_LT(box.min().z(), 0.05F) << i;
        EXPECT_LE(box.sizes().x(), size.length + 1.2F) << i;
        EXPECT_LE(box.sizes().y(), size.width + 0.4F) << i;
    }
}

TEST(Props, SignsAreSeenAsSignsFromBothSides) {
    for (const PropKind kind : {PropKind::speed_limit_sign, PropKind::stop_sign}) {
        world::Prop ahead = sign(kind, 30);
        // 14 cm beside the middle: from behind the pole stands before it.
        EXPECT_EQ(test::class_at(seen(ahead, world::SensorKind::semantic, 2.3), 95, 60),
                  SemanticClass::traffic_sign);
        ahead.mutate_yaw(3.14159265);
        EXPECT_EQ(test::class_at(seen(ahead, world::SensorKind::semantic, 2.3), 95, 60),
                  SemanticClass::traffic_sign);
    }
}

TEST(Props, SpeedLimitsShowTheirNumber) {
    const auto picture = [](std::uint16_t value) {
        return seen(sign(PropKind::speed_limit_sign, value), world::SensorKind::rgb, 2.3);
    };
    const world::SensorFrame thirty = picture(30);
    EXPECT_EQ(differing_bytes(thirty, picture(30)), 0);
    EXPECT_GT(differing_bytes(thirty, picture(50)), 100);
    EXPECT_GT(differing_bytes(thirty, picture(80)), 100);
    // Both show the same last digit: its half of the plate does not change.
    const world::SensorFrame fifty = picture(50);
    EXPECT_NEAR(test::mean(thirty, 1, 84, 50, 92, 70), test::mean(fifty, 1, 84, 50, 92, 70), 0.5);
}

TEST(Props, ParkedCarsAreCarsOfTheirModelAndPaint) {
    world::Prop car = test::all_props()[static_cast<std::size_t>(PropKind::parked_vehicle)];
    car.mutable_position() = world::Vec3(100, -6, 0.15);
    car.mutate_yaw(0.8);
    EXPECT_EQ(test::class_at(seen(car, world::SensorKind::semantic, 0.9), 80, 60),
              SemanticClass::car);
    const world::SensorFrame first = seen(car, world::SensorKind::rgb, 0.9);
    int painted = 0;
    for (std::uint32_t style = 1; style <= 4; ++style) {
        car.mutate_style(style);
        painted += differing_bytes(first, seen(car, world::SensorKind::rgb, 0.9)) > 1000;
    }
    EXPECT_GE(painted, 2);
}

TEST(SignalHeads, ShowWhatTheirSignalShows) {
    render::Sensors sensors(town_with_head());
    const auto off = head_colour(sensors, world::SignalColor::off);
    const auto gain = [&](world::SignalColor color) {
        const std::array<double, 3> lit = head_colour(sensors, color);
        return std::array<double, 2>{lit[0] - off[0], lit[1] - off[1]};
    };
    const auto [red_red, red_green] = gain(world::SignalColor::red);
    EXPECT_GT(red_red, 3);
    EXPECT_GT(red_red, 1.3 * red_green);
    const auto [green_red, green_green] = gain(world::SignalColor::green);
    EXPECT_GT(green_green, 3);
    EXPECT_GT(green_green, 1.3 * green_red);
    const auto [yellow_red, yellow_green] = gain(world::SignalColor::yellow);
    EXPECT_GT(yellow_red, 3);
    EXPECT_GT(yellow_green, 1.3 * red_green);
}

TEST(SignalHeads, TurnsWithASignalOfTheirOwnHaveALampOfTheirOwn) {
    world::TownT town = town_with_head();
    town.signals.push_back(town.signals[0]);
    town.signals[1].index = 1;
    town.heads[0].signals = {0, 1};
    render::Sensors sensors(town);
    const auto seen_with = [&](world::SignalColor turn) {
        const world::SealedTick tick = test::tick_with({}, {}, {world::SignalColor::red, turn});
        world::SensorSpec spec = test::camera(world::SensorKind::rgb, {94, -6, 3.1});
        spec.fov = 0.25;
        return sensors.observe(tick.view(), {spec}, test::noon())[0];
    };
    EXPECT_GT(
        differing_bytes(seen_with(world::SignalColor::red), seen_with(world::SignalColor::green)),
        30);
    // Who must give way is not told that the way is free.
    EXPECT_EQ(differing_bytes(seen_with(world::SignalColor::red),
                              seen_with(world::SignalColor::green_minor)),
              0);
}

TEST(SignalHeads, LampsOfTurnsAreArrowsThatPointTheirWay) {
    for (const world::Turn turn : {world::Turn::left, world::Turn::right}) {
        world::TownT town = town_with_head();
        town.signals.push_back(town.signals[0]);
        town.lanes[town.signals[0].lane].links = {
            world::Link(0, 0, 0, world::Turn::straight, false, 0),
            world::Link(0, 0, 1, turn, false, 0)};
        town.heads[0].signals = {0, 1};
        Mesh mesh;
        add_signal_head(mesh, town, town.heads[0], Eigen::Vector3d::Zero());
        // Of what lights: how high it is at each distance from the pole, to the left.
        const std::uint32_t tag = 4 + static_cast<std::uint32_t>(render::SignalLamp::turn);
        std::map<float, float> heights;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (const std::uint32_t vertex : mesh.triangles[i])
                if (mesh.materials[i] == render::Material::signal_lamp && mesh.tags[i] == tag) {
                    const Eigen::Vector3f& p = mesh.vertices[vertex];
                    heights[p.y() + 6] = std::max(heights[p.y() + 6], p.z());
                }
        ASSERT_GE(heights.size(), 3U);
        const auto& [right_end, right_height] = *heights.begin();
        const auto& [left_end, left_height] = *heights.rbegin();
        if (turn == world::Turn::left) {
            EXPECT_GT(right_end, 0.1F);
            EXPECT_LT(left_height, right_height);
        } else {
            EXPECT_LT(left_end, -0.1F);
            EXPECT_LT(right_height, left_height);
        }
    }
}

TEST(Plots, CoverTheirOutlineJustAboveTheTerrain) {
    world::TownT town = test::straight_road(200);
    town.plots = {test::plot(world::PlotKind::lawn, 60, 12, 81, 33),
                  test::plot(world::PlotKind::water, 100, -40, 120, -15),
                  test::plot(world::PlotKind::gravel, 65, 17, 75, 40)};
    const ground::GroundMesh ground = ground::build_ground(town);
    const Mesh mesh = render::plot_mesh(town, ground, Eigen::Vector3d::Zero());
    std::array<double, 3> area{};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Eigen::Vector3f& a = mesh.vertices[mesh.triangles[i][0]];
        const Eigen::Vector3f normal = (mesh.vertices[mesh.triangles[i][1]] - a)
                                           .cross(mesh.vertices[mesh.triangles[i][2]] - a);
        area.at(mesh.tags[i]) += static_cast<double>(normal.z()) / 2;
    }
    EXPECT_NEAR(area[0], 21 * 21 - 10 * 16, 0.5);  // what the later gravel leaves of it
    EXPECT_NEAR(area[1], 20 * 25, 0.5);
    EXPECT_NEAR(area[2], 10 * 23, 0.5);
    for (const Eigen::Vector3f& vertex : mesh.vertices)
        EXPECT_NEAR(vertex.z(), -0.05 + 0.01, 0.005);
}

TEST(Plots, AreOfTheClassOfTheirKind) {
    using world::PlotKind;
    const std::map<PlotKind, SemanticClass> expected{{PlotKind::lawn, SemanticClass::terrain},
                                                     {PlotKind::water, SemanticClass::water},
                                                     {PlotKind::square, SemanticClass::ground},
                                                     {PlotKind::car_park, SemanticClass::ground}};
    for (const auto& [kind, expectation] : expected) {
        world::TownT town = test::straight_road(200);
        town.plots = {test::plot(kind, 70, 6, 140, 40)};
        render::Sensors sensors(town);
        world::SensorSpec spec = test::camera(world::SensorKind::semantic, {80, 15, 3});
        spec.pitch = -0.3;
        const world::SealedTick tick = test::tick_with({});
        const auto frame = sensors.observe(tick.view(), {spec}, test::noon())[0];
        EXPECT_EQ(test::class_at(frame, 80, 80), expectation) << static_cast<int>(kind);
    }
}

TEST(Town, WithEverythingLooksTheSameTwiceInBothTracers) {
    world::TownT town = test::straight_road_with_signal(300);
    town.buildings = test::all_buildings();
    town.trees = test::all_plants();
    town.props = test::all_props();
    town.plots = {test::plot(world::PlotKind::park, 12, 12, 30, 30)};
    const world::SealedTick tick = test::street_tick();
    world::SensorFrame embree;
    for (const bool portable : {false, true}) {
        render::Sensors first(town, {.portable = portable});
        render::Sensors again(town, {.portable = portable});
        const auto one = first.observe(tick.view(), test::street_rig(), test::rain());
        const auto two = again.observe(tick.view(), test::street_rig(), test::rain());
        for (std::size_t i = 0; i < one.size(); ++i)
            EXPECT_EQ(one[i].data, two[i].data);
        if (!portable)
            embree = one[2];
        else
            EXPECT_LT(differing_bytes(one[2], embree), static_cast<int>(one[2].data.size() / 500));
    }
}

TEST(Town, ThingsWithoutSizeOrShapeAreLeftOut) {
    world::TownT town = test::straight_road_with_signal(200);
    town.buildings = {{world::Vec3(60, 20, 0), 0.3, 0, 0, 0, 1, 3},
                      {world::Vec3(80, 20, 0), 0.3, 12, 9, 6, 1, 4000}};
    town.trees = {{world::Vec3(70, 8, 0), 0, 2, 1, world::PlantKind::lime},
                  {world::Vec3(75, 8, 0), 6, 0, 1, world::PlantKind::any}};
    town.plots = {world::PlotT(), test::plot(world::PlotKind::park, 50, 10, 90, 40)};
    std::swap(town.plots[1].outline[0], town.plots[1].outline[1]);
    town.drawn_buildings.emplace_back();
    town.heads.emplace_back();
    town.heads.emplace_back().signals = {999};
    const world::SealedTick tick = test::street_tick();
    for (const bool portable : {false, true}) {
        render::Sensors sensors(town, {.portable = portable});
        const auto frames = sensors.observe(tick.view(), test::street_rig(), test::noon());
        EXPECT_THAT(frames[2].data,
                    testing::Contains(static_cast<std::uint8_t>(SemanticClass::building)));
    }
}

}  // namespace reprise
