#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "ground/mesh/roofs.h"
#include "render/shapes/buildings/building_mesh.h"
#include "render/shapes/buildings/building_plan.h"
#include "render/shapes/street/plant_mesh.h"
#include "tests/render/everything.h"
#include "world/geometry2d.h"

namespace reprise {

namespace {

using Eigen::Vector3f;
using render::Facades;
using render::Mesh;

struct Built {
    Mesh mesh;
    Facades facades;
};

Built build(const world::Building& building) {
    Built built;
    add_model_building(built.mesh, built.facades, building, Eigen::Vector3d::Zero());
    drop_degenerate(built.mesh);
    return built;
}

/// A building of each model around the world's origin.
std::vector<world::Building> models() {
    std::vector<world::Building> all;
    for (std::uint32_t i = 0; i < world::building_models().size(); ++i)
        all.push_back(test::building_of(i, 0, 0, 0));
    return all;
}

/// Does a ray meet any triangle? (Moeller and Trumbore, 1997.)
bool is_stopped(const Mesh& mesh, const Vector3f& from, const Vector3f& direction) {
    for (const auto& corners : mesh.triangles) {
        const Vector3f& a = mesh.vertices[corners[0]];
        const Vector3f u = mesh.vertices[corners[1]] - a;
        const Vector3f v = mesh.vertices[corners[2]] - a;
        const Vector3f p = direction.cross(v);
        const float det = u.dot(p);
        const Vector3f t = (from - a) / det;
        const float s = t.dot(p);
        const float r = direction.dot(t.cross(u));
        if (s >= -1e-4F && r >= -1e-4F && s + r <= 1 + 1e-4F && v.dot(t.cross(u)) > 0)
            return true;
    }
    return false;
}

/// Directions over the upper half sphere, evenly.
std::vector<Vector3f> upper_directions(int count) {
    std::vector<Vector3f> directions;
    for (int i = 0; i < count; ++i) {
        const double z = (i + 0.5) / count;
        const double angle = 2.399963 * i;
        const double wide = std::sqrt(1 - z * z);
        directions.push_back(
            Eigen::Vector3d(wide * std::cos(angle), wide * std::sin(angle), z).cast<float>());
    }
    return directions;
}

int escaping_rays(const Mesh& mesh, const Vector3f& from) {
    int escaping = 0;
    for (const Vector3f& direction : upper_directions(150))
        escaping += is_stopped(mesh, from, direction) ? 0 : 1;
    return escaping;
}

}  // namespace

TEST(ModelBuilding, NoRayLeavesTheInside) {
    for (const world::Building& building : models()) {
        const Mesh mesh = build(building).mesh;
        const char* name = world::building_models()[building.model() - 1].name;
        const auto y = static_cast<float>(building.width() / 2);
        const auto x = static_cast<float>(building.length() / 2);
        const auto top = static_cast<float>(building.height());
        for (const Vector3f& from : {Vector3f(0.31F * x, 0.37F * y, 0.3F * top),
                                     Vector3f(-0.83F * x, 0.71F * y, 0.85F * top),
                                     Vector3f(0.9F * x, -0.1F * y, 0.05F * top)})
            EXPECT_EQ(escaping_rays(mesh, from), 0) << name << ' ' << from.transpose();
    }
}

TEST(ModelBuilding, StandsOnItsFootprintBelowItsRoof) {
    for (const world::Building& building : models()) {
        const world::BuildingModel& model = world::building_models()[building.model() - 1];
        const bool tower = (model.parts & world::part_clock) != 0 ||
                           model.roof == world::RoofKind::spire ||
                           model.use == world::BuildingUse::tower;
        Eigen::AlignedBox3f box;
        for (const Vector3f& vertex : build(building).mesh.vertices)
            box.extend(vertex);
        // Balconies, awnings and eaves stand out.
        const double out = 1.35;
        EXPECT_LE(box.max().x(), building.length() / 2 + out) << model.name;
        EXPECT_GE(box.min().x(), -building.length() / 2 - out) << model.name;
        EXPECT_LE(box.max().y(), building.width() / 2 + out) << model.name;
        EXPECT_GE(box.min().y(), -building.width() / 2 - out) << model.name;
        EXPECT_GE(box.max().x(), building.length() / 2) << model.name;
        EXPECT_GE(box.max().z(), building.height() - 0.01) << model.name;
        EXPECT_LE(box.max().z(), building.height() + (tower ? 32 : 10)) << model.name;
        EXPECT_NEAR(static_cast<double>(box.min().z()), -8, 0.01) << "a foundation for slopes";
    }
}

TEST(ModelBuilding, FiveHundredHaveLessThanTwoMillionTriangles) {
    std::size_t sum = 0;
    for (const world::Building& building : models()) {
        const std::size_t triangles = build(building).mesh.triangles.size();
        EXPECT_LT(triangles, 9000U) << world::building_models()[building.model() - 1].name;
        sum += triangles;
    }
    EXPECT_LT(sum * 500 / 40, 2000000U);
}

TEST(ModelBuilding, IsTheSameForTheSameStyleAndPaintedByIt) {
    int repainted = 0;
    for (const world::Building& building : models()) {
        const Built first = build(building);
        const Built again = build(building);
        ASSERT_EQ(first.mesh.vertices.size(), again.mesh.vertices.size());
        for (std::size_t i = 0; i < first.mesh.vertices.size(); ++i)
            ASSERT_EQ(first.mesh.vertices[i], again.mesh.vertices[i]);
        world::Building other = building;
        other.mutate_style(building.style() + 1);
        const Built changed = build(other);
        repainted += changed.facades.buildings[0].wall == first.facades.buildings[0].wall ? 0 : 1;
    }
    EXPECT_GE(repainted, 38);
}

TEST(ModelBuilding, EveryTriangleIsTaggedWithWhatTheTownHolds) {
    Built town;
    for (const world::Building& building : models())
        add_model_building(town.mesh, town.facades, building, Eigen::Vector3d::Zero());
    EXPECT_EQ(town.facades.buildings.size(), 40U);
    for (std::size_t i = 0; i < town.mesh.triangles.size(); ++i) {
        if (town.mesh.materials[i] == render::Material::wall) {
            ASSERT_LT(town.mesh.tags[i], town.facades.walls.size());
            ASSERT_LT(town.facades.walls[town.mesh.tags[i]].building, 40U);
        } else {
            ASSERT_EQ(town.mesh.materials[i], render::Material::building);
            ASSERT_LT(town.mesh.tags[i] / render::building_finishes, 40U);
        }
    }
}

TEST(DrawnBuilding, ConcaveOutlinesAreClosedAndRoofedWhole) {
    world::DrawnBuildingT drawn;
    drawn.outline = {world::Vec3(0, 0, 1),
                     world::Vec3(20, 0, 1),
                     world::Vec3(20, 8, 1),
                     world::Vec3(8, 8, 1),
                     world::Vec3(8, 18, 1),
                     world::Vec3(0, 18, 1)};
    drawn.height = 12;
    drawn.style = 4;
    Built built;
    add_drawn_building(built.mesh, built.facades, drawn, Eigen::Vector3d::Zero());
    EXPECT_EQ(escaping_rays(built.mesh, {4, 13, 3}), 0);
    EXPECT_EQ(escaping_rays(built.mesh, {16, 4, 3}), 0);
    double deck = 0;
    for (std::size_t i = 0; i < built.mesh.triangles.size(); ++i) {
        const auto& corners = built.mesh.triangles[i];
        const Vector3f& a = built.mesh.vertices[corners[0]];
        const Vector3f normal =
            (built.mesh.vertices[corners[1]] - a).cross(built.mesh.vertices[corners[2]] - a);
        if (built.mesh.tags[i] % render::building_finishes ==
                static_cast<std::uint32_t>(render::BuildingFinish::deck) &&
            built.mesh.materials[i] == render::Material::building)
            deck += static_cast<double>(normal.z()) / 2;
    }
    EXPECT_NEAR(deck, 20 * 8 + 8 * 10, 0.1);
}

TEST(DrawnBuilding, PlainConvexOutlinesHaveThePitchedRoofOfTheirModel) {
    world::DrawnBuildingT drawn;
    drawn.outline = {world::Vec3(0, 0, 0),
                     world::Vec3(10, 0, 0),
                     world::Vec3(13, 6, 0),
                     world::Vec3(6, 11, 0),
                     world::Vec3(-1, 7, 0)};
    drawn.height = 6;
    drawn.model = 1 + *world::find_building_model("cottage");
    Built built;
    add_drawn_building(built.mesh, built.facades, drawn, Eigen::Vector3d::Zero());
    EXPECT_EQ(escaping_rays(built.mesh, {5, 4, 2}), 0);
    Eigen::AlignedBox3f box;
    for (const Vector3f& vertex : built.mesh.vertices)
        box.extend(vertex);
    const double rise = ground::hipped_rise(world::in_plan(drawn.outline));
    EXPECT_GT(rise, 2);
    EXPECT_NEAR(static_cast<double>(box.max().z()), 6 + rise, 0.2);
}

/// What reads a map's heights counts on it.
TEST(ModelBuilding, IsAsHighAsItsRoofRises) {
    for (const world::Building& building : models()) {
        const world::BuildingModel& model = world::building_models()[building.model() - 1];
        const auto x = static_cast<float>(building.length() / 2);
        const auto y = static_cast<float>(building.width() / 2);
        const bool spire = model.roof == world::RoofKind::spire;
        // Machines, clocks and chimneys stand out of roofs.
        if (!spire &&
            (model.roof == world::RoofKind::dome || model.roof == world::RoofKind::mansard ||
             (model.parts & (world::part_chimney | world::part_clock | world::part_roof_plant)) !=
                 0))
            continue;
        float top = 0;
        for (const Vector3f& vertex : build(building).mesh.vertices)
            top = std::max(top, vertex.z());
        const float rise = ground::roof_rise(model, x, y, ground::building_seed(building.style())) +
                           (spire ? ground::spire_rise(model, y) : 0);
        const double cross = spire ? 1.3 : 0;
        EXPECT_NEAR(
            static_cast<double>(top), building.height() + static_cast<double>(rise) + cross, 0.25)
            << model.name;
    }
}

TEST(DrawnBuilding, BrokenOutlinesBuildNothing) {
    Built built;
    world::DrawnBuildingT drawn;
    drawn.height = 8;
    add_drawn_building(built.mesh, built.facades, drawn, Eigen::Vector3d::Zero());
    drawn.outline = {world::Vec3(0, 0, 0), world::Vec3(0, 0, 0), world::Vec3(5, 0, 0)};
    add_drawn_building(built.mesh, built.facades, drawn, Eigen::Vector3d::Zero());
    EXPECT_TRUE(built.mesh.triangles.empty());
}

TEST(Plant, EveryKindStaysInItsUnitBoxWithinItsTriangles) {
    for (std::uint32_t kind = 1; kind <= 11; ++kind) {
        const Mesh mesh = render::plant_mesh(static_cast<world::PlantKind>(kind));
        EXPECT_LE(mesh.triangles.size(), 10500U) << kind;
        EXPECT_EQ(mesh.normals.size(), mesh.triangles.size()) << kind;
        float highest = 0;
        for (const Vector3f& vertex : mesh.vertices) {
            EXPECT_LT(vertex.head<2>().norm(), 1.3F) << kind;
            EXPECT_GT(vertex.z(), -0.15F) << kind;
            highest = std::max(highest, vertex.z());
        }
        EXPECT_NEAR(highest, 1, 0.15) << kind;
    }
}

}  // namespace reprise
