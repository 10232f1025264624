#include "render/shapes/people/carried.h"

#include <cmath>
#include <numbers>

namespace reprise::render {

namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double handle_height = 0.98;  // [m] of a rolling bag's handle above its wheels

void box(Mesh& mesh, const Vector3f& centre, const Vector3f& half, Material material) {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.translation() = centre;
    add_box(mesh, pose, half, {material});
}

void rod(Mesh& mesh, const Vector3f& from, const Vector3f& to, float radius, Material material) {
    add_tube(mesh, {from, to, radius, radius, 8}, {material});
}

void add_canopy(Mesh& mesh) {
    constexpr int ribs = 8;
    std::vector<std::vector<Vector3f>> rings;
    const auto ring_at = [&](float radius, float z, float droop) {
        std::vector<Vector3f>& ring = rings.emplace_back();
        for (int i = 0; i < 2 * ribs; ++i) {
            // The cloth hangs in between the ribs.
            const double angle = std::numbers::pi * i / ribs;
            const float r = i % 2 == 0 ? radius : radius * (1 - droop);
            ring.emplace_back(r * static_cast<float>(std::cos(angle)),
                              r * static_cast<float>(std::sin(angle)),
                              z);
        }
    };
    ring_at(0.001F, .72F, 0);
    for (const float out : {.50F, .46F, .34F, .18F, .001F})
        ring_at(out, .985F - .78F * out * out - (out > .45F ? .02F : 0), out > .3F ? .07F : .03F);
    rings[0] = std::vector<Vector3f>(2 * ribs, Vector3f(0, 0, .88F));
    add_loft(mesh, rings, true, {Material::umbrella});
    rod(mesh, {0, 0, -.08F}, {0, 0, 1.02F}, .007F, Material::eye);
}

void add_guitar_case(Mesh& mesh) {
    // Along z from the wide end to the head; x is its thickness.
    struct Station {
        float z, half;
    };

    std::vector<std::vector<Vector3f>> rings;
    for (const Station& s : {Station{-.02F, .001F},
                             Station{0, .11F},
                             Station{.07F, .185F},
                             Station{.20F, .19F},
                             Station{.33F, .145F},
                             Station{.44F, .155F},
                             Station{.54F, .11F},
                             Station{.60F, .06F},
                             Station{.95F, .055F},
                             Station{1.02F, .065F},
                             Station{1.06F, .001F}}) {
        const float thick = s.half < .01F ? .001F : .065F;
        rings.push_back({{thick, -s.half, s.z},
                         {thick, s.half, s.z},
                         {-thick, s.half, s.z},
                         {-thick, -s.half, s.z}});
    }
    add_loft(mesh, rings, true, {Material::bag});
}

Affine3d at(const Vector3d& place) {
    return Affine3d(Eigen::Translation3d(place));
}

}  // namespace

void hold(Posture& posture,
          const BodyProportions& body,
          const world::Carried& carried,
          bool rains) {
    const double h = body.height;
    const Eigen::Isometry3d trunk = posture.trunk();
    const double arm = 0.98 * (body.upper_arm + body.forearm);
    if (carried.rolling_bag)
        posture.wrist[1] =
            posture.shoulder(body, 1) + Vector3d(-0.38, -0.10, -0.90).normalized() * arm;
    if (carried.suitcase)
        posture.wrist[1] = posture.shoulder(body, 1) + Vector3d(0.02, -0.12, -1).normalized() * arm;
    if (carried.phone)
        posture.wrist[1] = trunk * Vector3d(0.155 * h, -0.045 * h, body.trunk - 0.055 * h);
    if (carried.shopping_bags)
        posture.wrist[0] = posture.shoulder(body, 0) + Vector3d(0.02, 0.10, -1).normalized() * arm;
    if (carried.umbrella && rains)
        posture.wrist[0] = trunk * Vector3d(0.125 * h, 0.05 * h, body.trunk - 0.10 * h);
}

void add_carried(std::vector<FigurePart>& parts,
                 const Posture& posture,
                 const BodyProportions& body,
                 const world::Carried& carried,
                 bool rains) {
    using Shape = FigurePart::Shape;
    const Affine3d trunk(posture.trunk());
    const auto add = [&](Shape shape, const Affine3d& pose) {
        parts.push_back({shape, Material::bag, pose});
    };
    const double depth = 0.075 * body.height;
    if (carried.backpack)
        add(Shape::backpack,
            trunk * at({-depth, 0, 0.58 * body.trunk}) * Eigen::Scaling(body.height / 1.75));
    if (carried.guitar_case)
        add(Shape::guitar_case,
            trunk * at({-depth - 0.07, -0.10, -0.16}) *
                Eigen::AngleAxisd(-0.30, Vector3d::UnitX()));
    const Vector3d& right = posture.wrist[1];
    const Vector3d& left = posture.wrist[0];
    const Vector3d palm(0, 0, -0.04 * body.height);
    if (carried.phone)
        add(Shape::phone,
            at(right + Vector3d(.02, .01, .05)) * Eigen::AngleAxisd(-0.55, Vector3d::UnitY()));
    if (carried.suitcase)
        add(Shape::suitcase, at(right + palm));
    if (carried.rolling_bag) {
        // From the hand down to the wheels, that run on the ground behind.
        const double drop = std::max(0.1, (right + palm).z());
        const double tilt = std::acos(std::min(0.999, drop / handle_height));
        add(Shape::rolling_bag, at(right + palm) * Eigen::AngleAxisd(tilt, Vector3d::UnitY()));
    }
    if (carried.shopping_bags)
        add(Shape::shopping_bag, at(left + palm));
    if (carried.umbrella && rains)
        add(Shape::open_umbrella,
            at(left) * Eigen::AngleAxisd(0.10, Vector3d::UnitY()) *
                Eigen::AngleAxisd(0.08, Vector3d::UnitX()));
    if (carried.umbrella && !rains)
        add(Shape::closed_umbrella, at(left + palm));
}

Mesh thing_mesh(FigurePart::Shape shape) {
    using Shape = FigurePart::Shape;
    Mesh mesh;
    switch (shape) {
        case Shape::phone:
            box(mesh, {0, 0, .02F}, {.005F, .037F, .075F}, Material::eye);
            break;
        case Shape::shopping_bag:
            box(mesh, {0, .03F, -.38F}, {.16F, .05F, .20F}, Material::bag);
            rod(mesh, {-.06F, .03F, -.19F}, {0, 0, 0}, .006F, Material::bag);
            rod(mesh, {.06F, .03F, -.19F}, {0, 0, 0}, .006F, Material::bag);
            break;
        case Shape::guitar_case:
            add_guitar_case(mesh);
            break;
        case Shape::suitcase:
            box(mesh, {0, -.02F, -.27F}, {.27F, .075F, .20F}, Material::bag);
            box(mesh, {0, -.02F, -.27F}, {.272F, .012F, .202F}, Material::eye);
            rod(mesh, {-.07F, 0, -.04F}, {.07F, 0, -.04F}, .012F, Material::eye);
            rod(mesh, {-.07F, 0, -.04F}, {-.07F, 0, -.08F}, .009F, Material::eye);
            rod(mesh, {.07F, 0, -.04F}, {.07F, 0, -.08F}, .009F, Material::eye);
            break;
        case Shape::rolling_bag:
            box(mesh, {-.13F, 0, -.68F}, {.11F, .18F, .26F}, Material::bag);
            box(mesh, {-.245F, 0, -.74F}, {.012F, .14F, .14F}, Material::bag);
            for (const float side : {-.15F, .15F}) {
                rod(mesh, {-.03F, side * .7F, -.42F}, {0, side * .7F, 0}, .008F, Material::eye);
                rod(mesh, {-.03F, side, -.94F}, {-.03F, side * 1.15F, -.94F}, .04F, Material::eye);
            }
            rod(mesh, {0, -.105F, 0}, {0, .105F, 0}, .011F, Material::eye);
            break;
        case Shape::open_umbrella:
            add_canopy(mesh);
            break;
        case Shape::closed_umbrella:
            add_tube(mesh, {{0, 0, -.12F}, {0, 0, -.62F}, .028F, .012F, 8}, {Material::umbrella});
            rod(mesh, {0, 0, .04F}, {0, 0, -.70F}, .007F, Material::eye);
            break;
        case Shape::backpack:
            add_ellipsoid(mesh, {-.09F, 0, .02F}, {.13F, .165F, .25F}, 14, {Material::bag});
            add_ellipsoid(mesh, {-.18F, 0, -.06F}, {.08F, .12F, .12F}, 12, {Material::bag});
            for (const float side : {-.11F, .11F})  // straps over the shoulders
                rod(mesh, {.155F, side, .02F}, {.03F, side, .235F}, .02F, Material::bag);
            break;
        default:
            break;
    }
    drop_degenerate(mesh);
    smooth(mesh, 0.7);
    return mesh;
}

}  // namespace reprise::render
