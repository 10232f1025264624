#include "render/shapes/people/figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "render/shapes/people/body.h"
#include "render/shapes/people/posture.h"
#include "world/models/gait.h"

namespace reprise::render {
namespace {

using Eigen::Vector3d;
using world::WalkerModel;

world::WalkerState walker(
    std::uint16_t model, float speed, float phase, bool down = false, std::uint32_t look = 1) {
    return {world::Vec3(0, 0, 0), 0, speed, phase, 5, model, down, std::uint8_t{0}, look};
}

/// Of the body without what it carries.
Eigen::AlignedBox3d box_of(const WalkerModel& model, std::span<const FigurePart> parts) {
    Eigen::AlignedBox3d box;
    for (const FigurePart& part : parts)
        if (part.shape <= FigurePart::Shape::shoe)
            for (const Eigen::Vector3f& vertex : figure_part_mesh(part.shape, model).vertices)
                box.extend(part.pose * vertex.cast<double>());
    return box;
}

TEST(Figure, EveryModelStandsOnTheGroundAtItsHeight) {
    std::uint16_t index = 0;
    for (const WalkerModel& model : world::walker_models()) {
        const Eigen::AlignedBox3d box = box_of(model, figure(model, walker(index, 0, 0), false));
        EXPECT_NEAR(box.min().z(), 0, 0.03) << model.name;
        EXPECT_NEAR(box.max().z(), model.height, 0.11) << model.name;  // hats; the bent old
        EXPECT_LT(box.sizes().y(), 2.1 * model.shoulder_width) << model.name;
        EXPECT_LT(box.sizes().x(), 0.65 * model.height) << model.name;
        ++index;
    }
}

TEST(Figure, WalksByItsPhase) {
    std::uint16_t index = 0;
    for (const WalkerModel& model : world::walker_models()) {
        const auto speed = static_cast<float>(model.walking_speed);
        for (const float phase : {0.0F, 0.13F, 0.3F, 0.5F, 0.8F}) {
            const Eigen::AlignedBox3d box =
                box_of(model, figure(model, walker(index, speed, phase), false));
            EXPECT_NEAR(box.min().z(), 0, 0.11) << model.name << phase;  // runners fly
            EXPECT_GT(box.max().z(), 0.86 * model.height) << model.name << phase;
        }
        // Legs straddle when a foot touches down and pass each other a quarter later.
        const auto length = [&](float phase) {
            return box_of(model, figure(model, walker(index, speed, phase), false)).sizes().x();
        };
        EXPECT_GT(length(0), length(0.28F) + 0.05) << model.name;
        ++index;
    }
}

TEST(Figure, LiesWhenDown) {
    const WalkerModel& model = world::walker_models().front();
    const Eigen::AlignedBox3d box = box_of(model, figure(model, walker(0, 0, 0, true), false));
    EXPECT_LT(box.max().z(), 0.6);
    EXPECT_GT(box.min().z(), -0.1);
    EXPECT_GT(box.sizes().x(), 1.5);
}

/// Does a ray that starts at `from` and goes this way meet the mesh? (Moeller and Trumbore, 1997.)
bool is_covered(const Mesh& mesh, const Vector3d& from, const Vector3d& direction) {
    for (const auto& corners : mesh.triangles) {
        const Vector3d a = mesh.vertices[corners[0]].cast<double>();
        const Vector3d u = mesh.vertices[corners[1]].cast<double>() - a;
        const Vector3d v = mesh.vertices[corners[2]].cast<double>() - a;
        const Vector3d p = direction.cross(v);
        const double det = u.dot(p);
        const Vector3d t = (from - a) / det;
        const double s = t.dot(p);
        const double r = direction.dot(t.cross(u));
        if (s >= -1e-4 && r >= -1e-4 && s + r <= 1 + 1e-4 && v.dot(t.cross(u)) > 0)
            return true;
    }
    return false;
}

/// Of thighs, shanks and shoes above the hem's lower edge: points that stand out of it.
int bare_points(const WalkerModel& model, const Mesh& hem, std::span<const FigurePart> parts) {
    const auto worn = std::find_if(parts.begin(), parts.end(), [](const FigurePart& part) {
        return part.shape == FigurePart::Shape::hem;
    });
    const Eigen::Affine3d to_hem = worn->pose.inverse();
    const std::array<Mesh, 3> leg{bone_mesh(), bone_mesh(), shoe_mesh()};
    int bare = 0;
    for (std::size_t i = 3; i < parts.size(); ++i) {
        if (parts[i - 1].shape != FigurePart::Shape::bone ||
            parts[i].shape != FigurePart::Shape::shoe)
            continue;
        for (std::size_t part = 0; part < leg.size(); ++part)
            for (const Eigen::Vector3f& vertex : leg[part].vertices) {
                const Vector3d p = to_hem * (parts[i - 2 + part].pose * vertex.cast<double>());
                if (p.z() > 0.01 - hem_length(model) && p.z() < 0 && p.head<2>().norm() > 1e-6)
                    bare += is_covered(hem, p, Vector3d(p.x(), p.y(), 0).normalized()) ? 0 : 1;
            }
    }
    return bare;
}

TEST(Figure, NoLegShowsThroughACoatOrASkirt) {
    int dressed = 0;
    for (std::uint16_t index = 0; index < world::walker_models().size(); ++index) {
        const WalkerModel& model = world::walker_models()[index];
        if (hem_length(model) == 0)
            continue;
        ++dressed;
        const Mesh hem = figure_part_mesh(FigurePart::Shape::hem, model);
        for (std::uint32_t look = 1; look <= 12; ++look)
            EXPECT_EQ(
                bare_points(model, hem, figure(model, walker(index, 0, 0, false, look), false)), 0)
                << model.name << " stands, look " << look;
        for (const double speed : {model.walking_speed, 2.8})
            for (const float phase : {0.0F, .08F, .17F, .26F, .38F, .5F, .63F, .76F, .9F})
                EXPECT_EQ(
                    bare_points(
                        model,
                        hem,
                        figure(model, walker(index, static_cast<float>(speed), phase), false)),
                    0)
                    << model.name << " at " << speed << " m/s, phase " << phase;
    }
    EXPECT_GT(dressed, 12);
}

/// The phase counts walk_cycle_length(): what a foot on the ground goes back in the walker's frame
/// is what the walker goes ahead in the world.
TEST(Posture, AStandingFootStaysWhereItIsInTheWorld) {
    for (const WalkerModel& model : world::walker_models()) {
        const double cycle = world::walk_cycle_length(model.walking_speed, model.height);
        for (const std::size_t side : {0U, 1U}) {
            std::optional<Vector3d> touched;
            int ticks = 0;
            for (double phase = 0.02; phase < 0.30; phase += 0.01) {
                const double at = std::fmod(phase + (side == 0 ? 0 : 0.5), 1.0);
                const Posture posture = striding(model, model.walking_speed, at);
                Vector3d p_world = posture.toe[side];
                p_world.x() += cycle * phase;  // the walker's way since its foot came down
                if (!touched)
                    touched = p_world;
                EXPECT_NEAR(p_world.x(), touched->x(), 0.002) << model.name << phase;
                EXPECT_NEAR(p_world.y(), touched->y(), 1e-9) << model.name;
                ++ticks;
            }
            EXPECT_GT(ticks, 20);
        }
    }
}

/// A foot in the air may miss its place by a centimetre.
TEST(Posture, LegsReachTheirFeetWithoutStretching) {
    for (const WalkerModel& model : world::walker_models()) {
        const BodyProportions body(model);
        for (double phase = 0; phase < 1; phase += 0.02) {
            const Posture posture = striding(model, model.walking_speed, phase);
            const Vector3d hip = posture.hip + Vector3d(0, body.half_hip, 0);
            EXPECT_LT((posture.ankle(body, 0) - hip).norm(), 2 * body.thigh * 1.02)
                << model.name << phase;
            EXPECT_GE(posture.toe[0].z(), -1e-9) << model.name << phase;
        }
    }
}

TEST(Posture, JointsKeepTheLengthsOfTheirBones) {
    const Vector3d from(0.1, 0.2, 1.4);
    const Vector3d target(0.3, 0.1, 1.0);
    const Vector3d joint = joint_between(from, target, 0.3, 0.25, {-1, 0, 0});
    EXPECT_NEAR((joint - from).norm(), 0.3, 1e-9);
    EXPECT_NEAR((joint - target).norm(), 0.25, 1e-9);
    EXPECT_LT(joint.x(), 0.2) << "bent towards the pole";
}

TEST(Figure, UmbrellasOpenInTheRain) {
    const WalkerModel& model = world::walker_models().front();
    const auto count = [&](bool rains, FigurePart::Shape shape) {
        int found = 0;
        for (std::uint32_t look = 1; look <= 200; ++look)
            for (const FigurePart& part : figure(model, walker(0, 1.3F, 0.2F, false, look), rains))
                found += part.shape == shape ? 1 : 0;
        return found;
    };
    EXPECT_EQ(count(false, FigurePart::Shape::open_umbrella), 0);
    EXPECT_EQ(count(true, FigurePart::Shape::closed_umbrella), 0);
    EXPECT_GT(count(true, FigurePart::Shape::open_umbrella), 20);
    EXPECT_EQ(count(true, FigurePart::Shape::open_umbrella),
              count(false, FigurePart::Shape::closed_umbrella));
}

TEST(Figure, EverythingThatCanBeCarriedIsCarriedBySomebody) {
    std::array<int, figure_part_shapes> carriers{};
    std::uint16_t index = 0;
    for (const WalkerModel& model : world::walker_models()) {
        for (std::uint32_t look = 1; look <= 40; ++look)
            for (const FigurePart& part : figure(model, walker(index, 0, 0, false, look), false))
                ++carriers.at(static_cast<std::size_t>(part.shape));
        ++index;
    }
    carriers.at(static_cast<std::size_t>(FigurePart::Shape::open_umbrella)) =
        carriers.at(static_cast<std::size_t>(FigurePart::Shape::closed_umbrella));
    for (std::size_t shape = 0; shape < figure_part_shapes; ++shape)
        EXPECT_GT(carriers.at(shape), 5) << shape;
}

TEST(Rider, SitsInTheBoxOfHisTwoWheeler) {
    for (const world::VehicleModel& vehicle : world::vehicle_models()) {
        if (!world::is_two_wheeler(vehicle.body))
            continue;
        const CarShape shape(vehicle);
        const WalkerModel& model = rider_of(vehicle.body);
        for (const double crank : {0.0, 1.0, 2.5, 4.0}) {
            Eigen::AlignedBox3d box = box_of(model, rider(shape, outfit_of(model, 3), 0.1, crank));
            EXPECT_NEAR(box.max().z(), vehicle.height, 0.08) << vehicle.name;
            EXPECT_GT(box.min().z(), 0.02) << vehicle.name;
            for (const Eigen::Vector3f& vertex : two_wheeler_mesh(shape).vertices)
                box.extend(vertex.cast<double>());
            EXPECT_GT(box.min().x(), -vehicle.rear_overhang - 0.05) << vehicle.name;
            EXPECT_LT(box.max().x(), vehicle.length - vehicle.rear_overhang) << vehicle.name;
            EXPECT_LT(box.sizes().y(), vehicle.width + 0.2) << vehicle.name;
        }
    }
}

TEST(LeanAngle, BringsWeightAndCentrifugalForceIntoLine) {
    for (const double speed : {3.0, 8.0}) {
        const double yaw_rate = 0.4;
        const double lean = lean_angle(speed, yaw_rate);
        EXPECT_NEAR(std::tan(lean) * 9.81, speed * yaw_rate, 1e-9);
        EXPECT_NEAR(lean_angle(speed, -yaw_rate), -lean, 1e-12);
    }
}

}  // namespace
}  // namespace reprise::render
