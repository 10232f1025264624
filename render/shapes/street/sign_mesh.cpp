#include <cmath>
#include <numbers>

#include "render/shapes/builder.h"
#include "render/shapes/street/prop_mesh.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::PropKind;

/// Corners of a sign's face and the angle of the first, counter-clockwise as its readers see it.
struct Outline {
    int corners;
    double first;  ///< [rad] from the right
};

Outline outline_of(PropKind kind) {
    using std::numbers::pi;
    switch (kind) {
        case PropKind::speed_limit_sign:
            return {28, 0};
        case PropKind::stop_sign:
            return {8, pi / 8};
        case PropKind::yield_sign:
            return {3, -pi / 2};
        default:
            return {4, pi / 4};
    }
}

}  // namespace

void add_sign(Mesh& mesh, PropKind kind, const PropSize& size) {
    Builder build(mesh, Eigen::Isometry3f::Identity());
    const float middle = size.height - sign_radius - 0.03F;
    const auto centre_mm = static_cast<std::uint32_t>(middle * 1000 + 0.5F);
    const Finish pole{Material::prop, PropTag{kind, PropFinish::steel}.bits()};
    const Finish face{Material::prop, PropTag{kind, PropFinish::plate, centre_mm}.bits()};
    const Finish back{Material::prop, PropTag{kind, PropFinish::plate_back}.bits()};
    build.tube({{.045F, 0, -.1F}, {.045F, 0, size.height}, .03F, .03F, 10}, pole);
    const Outline outline = outline_of(kind);
    // Straight edges reach the same width as a round sign.
    const float reach = outline.corners == 4   ? sign_radius * 1.35F
                        : outline.corners == 3 ? sign_radius * 1.28F
                                               : sign_radius * 1.04F;
    const float lift = outline.corners == 3 ? 0.08F : 0.0F;
    // Readers drive along x: the face looks back at them, y is to their left.
    const auto corner = [&](int i, float x) {
        const double angle = outline.first + 2 * std::numbers::pi * i / outline.corners;
        return Vector3f(x,
                        -reach * static_cast<float>(std::cos(angle)),
                        middle + lift + reach * static_cast<float>(std::sin(angle)));
    };
    for (int i = 0; i < outline.corners; ++i) {
        build.triangle({Vector3f(0, 0, middle + lift), corner(i, 0), corner(i + 1, 0)}, face);
        build.triangle({Vector3f(.012F, 0, middle + lift), corner(i + 1, .012F), corner(i, .012F)},
                       back);
        build.quad({corner(i, 0), corner(i, .012F), corner(i + 1, .012F), corner(i + 1, 0)}, back);
    }
    for (const float z : {-.16F, .16F})
        build.box({.012F, -.18F, middle + z - .02F}, {.05F, .18F, middle + z + .02F}, back);
}

void add_street_light(Mesh& mesh, const PropSize& size) {
    Builder build(mesh, Eigen::Isometry3f::Identity());
    const PropKind kind = PropKind::street_light;
    const Finish pole{Material::prop, PropTag{kind, PropFinish::steel}.bits()};
    const Finish lamp{Material::prop, PropTag{kind, PropFinish::lamp}.bits()};
    const Finish iron{Material::prop, PropTag{kind, PropFinish::iron}.bits()};
    if (size.height < 5) {
        // A lantern on a short post, for parks and squares.
        build.tube({{0, 0, -.1F}, {0, 0, size.height - .5F}, .06F, .045F, 10}, iron);
        build.tube({{0, 0, -.1F}, {0, 0, .5F}, .10F, .08F, 10}, iron);
        const Vector3f foot(0, 0, size.height - .5F);
        build.lathe(foot, {{0, 0}, {.07F, 0}, {.17F, .32F}, {0, .32F}}, 10, lamp);
        build.lathe(foot, {{0, .3F}, {.24F, .32F}, {.06F, .46F}, {0, .5F}}, 10, iron);
        return;
    }
    const float top = size.height;
    const float arm = std::max(0.6F, size.length);
    build.tube({{0, 0, -.1F}, {0, 0, 1.1F}, .095F, .085F, 12}, pole);
    build.tube({{0, 0, 1.0F}, {0, 0, top - .7F}, .07F, .05F, 12}, pole);
    // The arm bends over in three steps.
    const std::array<Vector3f, 4> bend{{{0, 0, top - .75F},
                                        {.12F * arm, 0, top - .28F},
                                        {.45F * arm, 0, top - .06F},
                                        {arm - .3F, 0, top}}};
    for (std::size_t i = 0; i + 1 < bend.size(); ++i)
        build.tube({bend[i], bend[i + 1], .048F, .04F, 8}, pole);
    build.box({arm - .36F, -.13F, top - .05F}, {arm + .32F, .13F, top + .06F}, iron);
    build.box({arm - .26F, -.10F, top - .075F}, {arm + .27F, .10F, top - .045F}, lamp);
}

}  // namespace reprise::render
