#include "towns/check/ground_check.h"

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/mesh/ground_probe.h"
#include "tests/support/places.h"
#include "tests/support/plumb_line.h"
#include "tests/support/worlds.h"
#include "world/town.h"

namespace reprise {
namespace {

using ground::GroundMesh;
using ground::Surface;
using towns::Criterion;
using world::LaneKind;
using world::TownT;

const Criterion& find(const std::vector<Criterion>& criteria, const std::string& name) {
    for (const Criterion& criterion : criteria)
        if (criterion.name == name)
            return criterion;
    ADD_FAILURE() << "no criterion " << name;
    return criteria.front();
}

/// Moves every vertex of some surface.
GroundMesh moved(GroundMesh mesh, Surface surface, const Eigen::Vector3d& by) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (mesh.surfaces[i] == surface)
            for (std::uint32_t& vertex : mesh.triangles[i]) {
                mesh.vertices.push_back(mesh.vertices[vertex] + by);
                vertex = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
            }
    return mesh;
}

TEST(GroundCheck, PassesTheGroundOfItsTown) {
    for (const TownT& town : {test::t_junction(),
                              test::t_junction(0.03),
                              test::bridge(),
                              test::bend(),
                              test::straight_road(100, 2)})
        for (const Criterion& criterion : towns::check_ground(town, ground::build_ground(town)))
            EXPECT_TRUE(criterion.passed())
                << town.name << ": " << criterion.name << ' ' << criterion.figure;
}

/// A road climbs by 15 % to a level junction, whose outline reaches over it, and turns off there at
/// once, at 45 degrees.
TownT climb_to_a_junction() {
    TownT town;
    town.name = "climb";
    town.lanes = {test::lane(":j_0", LaneKind::internal, {{50, 0, 0}, {60, 10, 0}}),
                  test::lane("up_1", LaneKind::driving, {{0, 0, -7.5}, {50, 0, 0}}),
                  test::lane("zz_1", LaneKind::driving, {{60, 10, 0}, {90, 40, 0}})};
    town.junctions.resize(1);
    town.junctions[0].outline = {{49.2, -2, 0}, {62, -2, 0}, {62, 12, 0}, {49.2, 12, 0}};
    town.lanes[0].junction = town.lanes[1].junction = 0;
    const auto ahead = world::Turn::straight;
    town.lanes[1].links = {{2, 0, world::none, ahead, false, 0}};
    town.lanes[0].links = {{2, world::none, world::none, ahead, false, 0}};
    return town;
}

TEST(GroundCheck, ALevelJunctionDoesNotStickOutOfASlopingRoad) {
    const TownT town = climb_to_a_junction();
    for (const Criterion& criterion : towns::check_ground(town, ground::build_ground(town)))
        if (criterion.name.starts_with("ground")) {
            EXPECT_LT(criterion.figure, 0.02) << criterion.name;
        }
}

TEST(GroundCheck, MeasuresHowFarTheGroundIsOffItsLane) {
    const TownT town = test::t_junction();
    const GroundMesh ground = moved(ground::build_ground(town), Surface::road, {0, 0, 0.08});
    const auto criteria = towns::check_ground(town, ground);
    const Criterion& off = find(criteria, "ground under lanes");
    EXPECT_FALSE(off.passed());
    EXPECT_NEAR(off.figure, 0.08, 1e-9);
    ASSERT_GE(off.worst.size(), 5U) << "all are known, however many are shown";
    EXPECT_NEAR(off.worst[0].value, 0.08, 1e-9);
}

/// A lane along x, and ground whose height is a function of y.
Criterion wheels_on(double (*height)(double)) {
    TownT town;
    town.name = "plank";
    town.lanes = {test::lane("ahead_0", LaneKind::driving, {{0, 0, 0}, {20, 0, 0}})};
    town.low = {0, -2, 0};
    town.high = {20, 2, 0};
    GroundMesh ground;
    for (double y = -2; y < 2; y += 0.05) {
        const auto first = static_cast<std::uint32_t>(ground.vertices.size());
        for (const double x : {-1, 21})
            for (const double side : {y, y + 0.05})
                ground.vertices.emplace_back(x, side, height(side));
        ground.triangles.push_back({first, first + 2, first + 3});
        ground.triangles.push_back({first, first + 3, first + 1});
        ground.surfaces.insert(ground.surfaces.end(), 2, Surface::road);
    }
    return find(towns::check_ground(town, ground), "ground under wheels");
}

TEST(GroundCheck, WheelsMayStandOnABankButNotOnAStep) {
    EXPECT_TRUE(wheels_on([](double y) { return 0.11 * y; }).passed());
    EXPECT_TRUE(wheels_on([](double y) { return 0.11 * std::max(y, 0.0); }).passed()) << "a ridge";
    EXPECT_FALSE(wheels_on([](double y) { return 0.15 * std::max(y, 0.0); }).passed()) << "steep";
    EXPECT_FALSE(wheels_on([](double y) { return y < 0.475 ? 0 : 0.07; }).passed()) << "a kerb";
}

TEST(GroundCheck, NamesTheLaneWithoutARoad) {
    TownT town = test::t_junction();
    const GroundMesh ground = ground::build_ground(town);
    town.lanes.push_back(test::lane("nowhere_0", LaneKind::driving, {{0, 40, 0}, {40, 40, 0}}));
    const Criterion off = find(towns::check_ground(town, ground), "ground under lanes");
    EXPECT_FALSE(off.passed());
    ASSERT_EQ(off.worst.size(), 1U);
    EXPECT_EQ(off.worst[0].name, "nowhere_0");
    EXPECT_NEAR(off.worst[0].position.y(), 40, 1e-9);
}

TEST(GroundCheck, MeasuresTheDistanceOfKerbs) {
    // The northern sidewalk starts 1.75 m from the centre line of the lanes that go west.
    const TownT town = test::straight_road(100);
    const GroundMesh ground = ground::build_ground(town);
    const double clear = find(towns::check_ground(town, ground), "kerbs clear of lanes").figure;
    EXPECT_NEAR(clear, 1.75, 0.01);
    const GroundMesh nearer =
        moved(moved(ground, Surface::kerb, {0, 1.2, 0}), Surface::sidewalk, {0, 1.2, 0});
    const Criterion kerbs = find(towns::check_ground(town, nearer), "kerbs clear of lanes");
    EXPECT_FALSE(kerbs.passed());
    EXPECT_NEAR(kerbs.figure, clear - 1.2, 0.01);
}

/// Adds a rectangle of sidewalk.
void add_sidewalk(GroundMesh& ground, const Eigen::Vector3d& low, double length, double width) {
    const auto first = static_cast<std::uint32_t>(ground.vertices.size());
    for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 0),
                                          Eigen::Vector3d(length, 0, 0),
                                          Eigen::Vector3d(length, width, 0),
                                          Eigen::Vector3d(0, width, 0)})
        ground.vertices.push_back(low + corner);
    for (const auto& [second, third] : {std::pair(1u, 2u), std::pair(2u, 3u)}) {
        ground.triangles.push_back({first, first + second, first + third});
        ground.surfaces.push_back(Surface::sidewalk);
    }
}

TEST(GroundCheck, CountsSplintersOfSidewalk) {
    const TownT town = test::bend();
    GroundMesh ground = ground::build_ground(town);
    const auto splinters = [&] {
        return find(towns::check_ground(town, ground), "splinters of sidewalk");
    };
    EXPECT_TRUE(splinters().passed());
    add_sidewalk(ground, {20, 20, 0.15}, 1.9, 2);
    add_sidewalk(ground, {30, 20, 0.15}, 10, 0.5);
    EXPECT_EQ(splinters().figure, 2) << "too small; too narrow";
    EXPECT_EQ(splinters().worst.at(0).name, "380 dm2 of sidewalk");
    add_sidewalk(ground, {21.94, 20, 0.15}, 1, 2);
    EXPECT_EQ(splinters().figure, 1) << "4 cm away: one island with the first";
    add_sidewalk(ground, {30, 20, 5.15}, 10, 4);
    EXPECT_EQ(splinters().figure, 1) << "a sidewalk on a bridge is no part of what is below";
    add_sidewalk(ground, {50, 20, 0.15}, 1.9, 2);
    add_sidewalk(ground, {50, 20, 0.15}, 1.9, 2);
    EXPECT_EQ(splinters().figure, 2) << "drawn twice is not twice as large";
}

TEST(GroundCheck, ComparesTheHeightOfKerbsWhereTheyLie) {
    TownT town;
    town.name = "slope";
    town.lanes = {test::lane("up_0", LaneKind::driving, {{0, 0, 0}, {150, 0, 12}})};
    town.low = {0, -2, 0};
    town.high = {150, 2, 12};
    const auto clear_of_kerb = [&](double x, double z) {
        GroundMesh ground = ground::build_ground(town);
        const auto first = static_cast<std::uint32_t>(ground.vertices.size());
        for (const auto& [dx, y] : {std::pair{0, 0.5}, std::pair{2, 0.5}, std::pair{1, 1.5}})
            ground.vertices.emplace_back(x + dx, y, z);
        ground.triangles.push_back({first, first + 1, first + 2});
        ground.surfaces.push_back(Surface::sidewalk);
        return find(towns::check_ground(town, ground), "kerbs clear of lanes").figure;
    };
    // On the road at its upper end; then at the road's mean height, 5 m below that end.
    EXPECT_NEAR(clear_of_kerb(140, 11.4), 0.5, 0.01);
    EXPECT_NEAR(clear_of_kerb(140, 6), 3.0, 0.01);
}

TEST(GroundCheck, HairpinsOverAWalkingAreaAreKeptClear) {
    TownT town = test::t_junction();
    world::LaneT area =
        test::lane(":far_w0", LaneKind::walking_area, {{200, 200, 0}, {240, 216, 0}});
    area.outline = {{190, 194, 0}, {245, 194, 0}, {245, 222, 0}, {190, 222, 0}};
    town.lanes.push_back(area);
    // A turn between two arms of a junction that leave it side by side, as netconvert draws it.
    town.lanes.push_back(test::lane(":far_0_0",
                                    LaneKind::internal,
                                    {{231.5, 213.5, 0},
                                     {210.8, 205, 0},
                                     {204.1, 200.8, 0},
                                     {211.2, 201, 0},
                                     {227.7, 204.6, 0}}));
    town.high = {260, 240, 1};
    const auto criteria = towns::check_ground(town, ground::build_ground(town));
    for (const char* name : {"kerbs clear of lanes", "ground under wheels"})
        EXPECT_TRUE(find(criteria, name).passed()) << name << ' ' << find(criteria, name).figure;
}

TEST(GroundCheck, CountsHolesAndGaps) {
    TownT town = test::t_junction();
    GroundMesh ground = ground::build_ground(town);
    GroundMesh roads{ground.vertices, {}, {}};
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
        if (ground.surfaces[i] != Surface::terrain) {
            roads.triangles.push_back(ground.triangles[i]);
            roads.surfaces.push_back(ground.surfaces[i]);
        }
    EXPECT_GT(find(towns::check_ground(town, roads), "holes in the ground").figure, 100);

    EXPECT_EQ(find(towns::check_ground(town, ground), "lanes join").figure, 0.05) << "no links yet";
    // east_in_1 leads to west_out_1 by :t_2_0, which starts where it ends.
    const auto at = [&](const char* name) { return *world::find_lane(town, name); };
    town.lanes[at("east_in_1")].links = {
        world::Link(at("west_out_1"), at(":t_2_0"), world::none, world::Turn::straight, false, 0)};
    EXPECT_EQ(find(towns::check_ground(town, ground), "lanes join").figure, 0);
    town.lanes[at(":t_2_0")].centre[0] = world::Vec3(60, 1.75, 0.2);
    EXPECT_NEAR(find(towns::check_ground(town, ground), "lanes join").figure, 0.2, 1e-9);
}

TEST(GroundProbe, AgreesWithAPlumbLineThatAsksEveryTriangle) {
    const GroundMesh ground = ground::build_ground(test::t_junction(0.04));
    const ground::GroundProbe probe(ground);
    int hits = 0;
    // Off every border of a surface: which side of it counts is not promised.
    for (double x = -3.3; x < 105; x += 3.7)
        for (double y = -61.13; y < 10; y += 2.9)
            for (const double z : {1.0, 50.0}) {
                const auto slow = test::plumb(ground, {x, y, z});
                const auto fast = probe.below({x, y, z});
                ASSERT_EQ(slow.has_value(), fast.has_value()) << x << ' ' << y;
                if (!slow)
                    continue;
                EXPECT_NEAR(slow->z, fast->z, 1e-9);
                ++hits;
            }
    EXPECT_GT(hits, 500);
}

TEST(GroundProbe, TellsWhoWalksOnWhatItTellsEverybody) {
    const GroundMesh ground = ground::build_ground(test::t_junction(0.04));
    const ground::GroundProbe probe(ground);
    ground::GroundProbe::Around around;
    int hits = 0;
    for (double y = -61.13; y < 10; y += 2.9)
        for (double x = -3.3; x < 105; x += 0.13) {
            const Eigen::Vector3d from(x, y + 0.3 * x / 105, 1);
            const auto asked = probe.below(from);
            const auto remembered = probe.below(from, around);
            ASSERT_EQ(asked.has_value(), remembered.has_value()) << x << ' ' << y;
            if (!asked)
                continue;
            ASSERT_EQ(asked->z, remembered->z) << x << ' ' << y;
            ++hits;
        }
    EXPECT_GT(hits, 3000);
}

TEST(GroundProbe, FindsTheNearestLevel) {
    const GroundMesh ground = ground::build_ground(test::bridge());
    const ground::GroundProbe probe(ground);
    EXPECT_NEAR(probe.nearest({0.5, 0.5, 9})->z, 6, 1e-6);
    EXPECT_NEAR(probe.nearest({0.5, 0.5, 3.1})->z, 6, 1e-6);
    EXPECT_NEAR(probe.nearest({0.5, 0.5, 2.9})->z, 0, 1e-6);
    EXPECT_NEAR(probe.nearest({0.5, 0.5, -4})->z, 0, 1e-6);
    // The terrain closely below a road carries nothing else.
    EXPECT_EQ(probe.nearest({20.5, 0.5, -4})->surface, Surface::road);
    EXPECT_FALSE(probe.nearest({9000, 0, 0}).has_value());
}

TEST(GroundCheck, SeesEveryBitOfAMesh) {
    const GroundMesh ground = ground::build_ground(test::t_junction());
    GroundMesh other = ground;
    EXPECT_EQ(towns::digest_of(ground), towns::digest_of(other));
    other.vertices[3].z() += 1e-12;
    EXPECT_NE(world::to_hex(towns::digest_of(ground)), world::to_hex(towns::digest_of(other)));
}

}  // namespace
}  // namespace reprise
