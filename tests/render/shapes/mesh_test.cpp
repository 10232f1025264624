#include "render/shapes/mesh.h"

#include <map>
#include <numbers>

#include <gmock/gmock.h>

#include "render/shapes/buildings/building_mesh.h"
#include "render/shapes/cars/car_shape.h"
#include "render/shapes/street/plant_mesh.h"

namespace reprise {

namespace {

using render::Mesh;

/// By Gauss's theorem; positive when all triangles face outwards.
double volume(const Mesh& mesh) {
    double sum = 0;
    for (const auto& corners : mesh.triangles) {
        const Eigen::Vector3d a = mesh.vertices[corners[0]].cast<double>();
        const Eigen::Vector3d b = mesh.vertices[corners[1]].cast<double>();
        const Eigen::Vector3d c = mesh.vertices[corners[2]].cast<double>();
        sum += a.dot(b.cross(c)) / 6;
    }
    return sum;
}

const render::Finish any{render::Material::pole};

}  // namespace

TEST(Mesh, SolidsFaceOutwards) {
    Mesh box;
    add_box(box, Eigen::Isometry3f(Eigen::Translation3f(5, 6, 7)), {1, 2, 3}, any);
    EXPECT_NEAR(volume(box), 48, 1e-3);
    Mesh tube;
    add_tube(tube, {{1, 2, 3}, {1, 5, 3}, 0.5F, 0.5F, 64}, any);
    EXPECT_NEAR(volume(tube), std::numbers::pi * 0.25 * 3, 0.01);
    Mesh ball;
    add_ellipsoid(ball, {0, 0, 0}, {1, 2, 3}, 64, any);
    EXPECT_NEAR(volume(ball), 4.0 / 3 * std::numbers::pi * 6, 0.2);
}

TEST(Mesh, DropsTrianglesWithoutAreaOrNumbers) {
    Mesh mesh;
    add_quad(mesh, {Eigen::Vector3f(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, any);
    add_quad(mesh, {Eigen::Vector3f(0, 0, 0), {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, any);
    add_quad(mesh, {Eigen::Vector3f(0, 0, 0), {1, 0, 0}, {1, std::nanf(""), 0}, {0, 1, 0}}, any);
    drop_degenerate(mesh);
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_EQ(mesh.materials.size(), 2U);
    EXPECT_EQ(mesh.tags.size(), 2U);
}

TEST(Mesh, EveryVehicleFillsItsCataloguesBox) {
    for (const world::VehicleModel& model : world::vehicle_models()) {
        if (world::is_two_wheeler(model.body))
            continue;  // half of theirs is the rider's: see figure_test.cpp
        const render::CarShape shape(model);
        const Mesh body = car_body_mesh(shape);
        Eigen::AlignedBox3f box;
        // Mirrors stick out of the catalogue's width, as they do on the road.
        for (const Eigen::Vector3f& vertex : body.vertices)
            if (std::abs(vertex.y()) < static_cast<float>(model.width / 2) + 0.001F)
                box.extend(vertex);
        EXPECT_NEAR(box.min().x(), -model.rear_overhang, 0.02) << model.name;
        EXPECT_NEAR(box.max().x(), model.length - model.rear_overhang, 0.02) << model.name;
        // Signs and light bars stand on the roof.
        const double on_roof = model.livery == world::Livery::plain ? 0 : 0.15;
        EXPECT_GT(static_cast<double>(box.max().z()), model.height - 0.03) << model.name;
        EXPECT_LT(static_cast<double>(box.max().z()), model.height + 0.03 + on_roof) << model.name;
        EXPECT_NEAR(box.max().y(), model.width / 2, 0.03) << model.name;
        EXPECT_GT(box.min().z(), 0.1) << model.name;
        EXPECT_GT(volume(body), 0.3 * model.length * model.width * model.height) << model.name;
        EXPECT_THAT(body.triangles.size(), testing::AllOf(testing::Gt(2000U), testing::Lt(12000U)));
        EXPECT_EQ(body.normals.size(), body.triangles.size());
    }
}

TEST(Mesh, TreesStayInTheirUnitBox) {
    for (std::uint32_t kind = 0; kind < render::tree_kinds; ++kind) {
        for (const Eigen::Vector3f& vertex : render::tree_mesh(kind).vertices) {
            EXPECT_LT(vertex.head<2>().norm(), 1.25F);
            EXPECT_LT(vertex.z(), 1.15F);
        }
    }
}

}  // namespace reprise
