#include "render/figure.h"

#include <cmath>
#include <numbers>

namespace reprise::render {

namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

Affine3d stretched_bone(const Vector3d& from, const Vector3d& to, double radius) {
    const Vector3d axis = to - from;
    Affine3d pose = Affine3d::Identity();
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis);
    pose.linear() =
        turn.toRotationMatrix() * Eigen::DiagonalMatrix<double, 3>(radius, radius, axis.norm());
    pose.translation() = from;
    return pose;
}

Affine3d stretched_ball(const Vector3d& centre, const Vector3d& radii) {
    Affine3d pose = Affine3d::Identity();
    pose.linear() = radii.asDiagonal();
    pose.translation() = centre;
    return pose;
}

/// In the plane of walking: `angle` swings forward from straight down.
Vector3d hanging(double length, double angle) {
    return {length * std::sin(angle), 0, -length * std::cos(angle)};
}

struct Body {
    double height;
    double shoulder;
    double hip_height;
    double stride;  ///< 0 standing, 1 walking
    std::vector<Limb> limbs;

    void bone(Material material, const Vector3d& from, const Vector3d& to, double radius) {
        limbs.push_back({Limb::Shape::bone, material, stretched_bone(from, to, radius)});
    }

    void ball(Material material, const Vector3d& centre, const Vector3d& radii) {
        limbs.push_back({Limb::Shape::ball, material, stretched_ball(centre, radii)});
    }
};

void add_leg(Body& body, double side, double cycle) {
    const double h = body.height;
    const double hip = body.stride * (0.40 * std::cos(cycle) + 0.06);
    const double bend = std::max(0.0, std::sin(cycle + 3.6));
    const double knee = 0.06 + body.stride * 0.95 * bend * bend;
    const Vector3d top(0, side * 0.052 * h, body.hip_height);
    const Vector3d middle = top + hanging(0.245 * h, hip);
    const Vector3d ankle = middle + hanging(0.235 * h, hip - knee);
    body.bone(Material::trousers, top, middle, 0.048 * h);
    body.bone(Material::trousers, middle, ankle, 0.036 * h);
    const double pitch = hip - knee + 0.06;
    const Vector3d toe(0.105 * h * std::cos(pitch), 0, 0.105 * h * std::sin(pitch) - 0.012 * h);
    body.bone(
        Material::shoe, ankle - 0.25 * toe - Vector3d(0, 0, 0.012 * h), ankle + toe, 0.026 * h);
}

void add_arm(Body& body, double side, double cycle) {
    const double h = body.height;
    const double swing = -0.38 * body.stride * std::cos(cycle);
    const Vector3d top(0, side * body.shoulder * 0.43, 0.795 * h);
    const Vector3d out(0, side * 0.022 * h, 0);
    body.ball(Material::shirt, top, Vector3d::Constant(0.033 * h));
    const Vector3d elbow = top + hanging(0.17 * h, swing) + out;
    const Vector3d wrist = elbow + hanging(0.145 * h, swing + 0.25 + 0.15 * body.stride);
    body.bone(Material::shirt, top, elbow, 0.034 * h);
    body.bone(Material::shirt, elbow, wrist, 0.026 * h);
    body.ball(Material::skin, wrist, Vector3d(.022, .016, .03) * h);
}

void add_trunk(Body& body) {
    const double h = body.height;
    const double wide = body.shoulder * 0.5;
    body.ball(
        Material::trousers, {0, 0, body.hip_height + .015 * h}, {.068 * h, .088 * h, .075 * h});
    body.ball(Material::shirt, {0, 0, .635 * h}, {.072 * h, wide * .74, .125 * h});
    body.ball(Material::shirt, {0.004 * h, 0, .735 * h}, {.075 * h, wide * .88, .105 * h});
    body.bone(Material::skin, {0, 0, .80 * h}, {.008 * h, 0, .88 * h}, .034 * h);
    body.ball(Material::skin, {.012 * h, 0, .925 * h}, {.054 * h, .046 * h, .070 * h});
    body.ball(Material::hair, {-.006 * h, 0, .942 * h}, {.056 * h, .050 * h, .062 * h});
}

}  // namespace

Mesh ball_mesh() {
    Mesh mesh;
    add_ellipsoid(mesh, Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones(), 16, {Material::skin});
    drop_degenerate(mesh);
    smooth(mesh, 3);
    return mesh;
}

Mesh bone_mesh() {
    // Rings from pole to pole; the ends bulge by a third of the radius, as seen after stretching.
    Mesh mesh;
    std::vector<std::vector<Eigen::Vector3f>> rings;
    const std::vector<Eigen::Vector2d> outline{{0, -.10},
                                               {.6, -.075},
                                               {.9, -.03},
                                               {1, .05},
                                               {.97, .3},
                                               {.84, .7},
                                               {.72, .95},
                                               {.62, 1.03},
                                               {.4, 1.065},
                                               {0, 1.08}};
    for (const Eigen::Vector2d& point : outline) {
        std::vector<Eigen::Vector3f>& ring = rings.emplace_back();
        for (int i = 0; i < 12; ++i) {
            const double angle = 2 * std::numbers::pi * i / 12;
            ring.emplace_back(static_cast<float>(point.x() * std::cos(angle)),
                              static_cast<float>(point.x() * std::sin(angle)),
                              static_cast<float>(point.y()));
        }
    }
    add_loft(mesh, rings, true, {Material::skin});
    drop_degenerate(mesh);
    smooth(mesh, 3);
    return mesh;
}

std::vector<Limb> figure(const world::WalkerModel& model, const world::WalkerState& walker) {
    Body body{model.height, model.shoulder_width, 0.495 * model.height, 0, {}};
    const bool walks = walker.speed() > 0.05F && !walker.down();
    body.stride = walks ? std::min(1.0, 0.45 + static_cast<double>(walker.speed()) / 2.2) : 0;
    const double cycle = 2 * std::numbers::pi * static_cast<double>(walker.phase());
    // Straddled legs stand lower; the hip bobs twice a cycle.
    body.hip_height -= body.stride * 0.016 * model.height * (1 + std::cos(2 * cycle) * 0.6);
    for (const double side : {1.0, -1.0}) {
        const double leg = side > 0 ? cycle : cycle + std::numbers::pi;
        add_leg(body, side, leg);
        add_arm(body, side, leg);
    }
    add_trunk(body);
    if (walker.down()) {
        Affine3d lying = Affine3d::Identity();
        lying.linear() =
            Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitY()).toRotationMatrix();
        lying.translation() = Vector3d(-model.height / 2, 0, 0.14);
        for (Limb& limb : body.limbs)
            limb.pose = lying * limb.pose;
    }
    return body.limbs;
}

}  // namespace reprise::render
