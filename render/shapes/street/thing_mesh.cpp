#include "render/shapes/street/thing_mesh.h"

#include <cmath>
#include <numbers>

#include "render/shapes/builder.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr std::uint32_t white = 0xe8e8e4;
constexpr std::uint32_t black = 0x202022;

Finish painted(std::uint32_t paint) {
    return {Material::thing, paint};
}

struct Half {
    explicit Half(const world::PropModel& model)
        : length(static_cast<float>(model.length / 2)),
          width(static_cast<float>(model.width / 2)),
          height(static_cast<float>(model.height)) {}

    float length;
    float width;
    float height;  ///< whole
};

/// Rubber foot, and a cone with two white bands.
void add_cone(Builder& build, const world::PropModel& model) {
    const Half half(model);
    constexpr float foot = 0.03F;
    constexpr int sides = 20;
    build.box({-half.length, -half.width, 0}, {half.length, half.width, foot}, painted(black));
    const float wide = 0.72F * half.width;
    const float high = half.height - foot;
    const auto radius = [&](float share) { return wide + share * (0.03F - wide); };
    const auto band = [&](float from, float to, std::uint32_t paint) {
        build.lathe({0, 0, foot},
                    {{radius(from), from * high}, {radius(to), to * high}},
                    sides,
                    painted(paint));
    };
    band(0, 0.28F, model.paint);
    band(0.28F, 0.46F, white);
    band(0.46F, 0.60F, model.paint);
    band(0.60F, 0.78F, white);
    band(0.78F, 1, model.paint);
    build.lathe({0, 0, half.height}, {{0.03F, 0}, {0.001F, 0.001F}}, sides, painted(model.paint));
}

/// New Jersey's profile, the same on both sides.
void add_profile(Builder& build, const world::PropModel& model) {
    const Half half(model);
    const std::array<Vector2f, 4> steps{{{1, 0}, {1, 0.10F}, {0.55F, 0.40F}, {0.32F, 1}}};
    const Finish finish = painted(model.paint);
    const auto at = [&](float end, float side, const Vector2f& step) {
        return Vector3f(end * half.length, side * step.x() * half.width, step.y() * half.height);
    };
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
        build.quad({at(-1, -1, steps[i]),
                    at(1, -1, steps[i]),
                    at(1, -1, steps[i + 1]),
                    at(-1, -1, steps[i + 1])},
                   finish);
        build.quad({at(1, 1, steps[i]),
                    at(-1, 1, steps[i]),
                    at(-1, 1, steps[i + 1]),
                    at(1, 1, steps[i + 1])},
                   finish);
        build.quad({at(1, -1, steps[i]),
                    at(1, 1, steps[i]),
                    at(1, 1, steps[i + 1]),
                    at(1, -1, steps[i + 1])},
                   finish);
        build.quad({at(-1, 1, steps[i]),
                    at(-1, -1, steps[i]),
                    at(-1, -1, steps[i + 1]),
                    at(-1, 1, steps[i + 1])},
                   finish);
    }
    build.quad({at(-1, -1, steps[3]), at(1, -1, steps[3]), at(1, 1, steps[3]), at(-1, 1, steps[3])},
               finish);
}

/// A red rim around nothing, on wire feet; it faces along x.
void add_triangle(Builder& build, const world::PropModel& model) {
    const Half half(model);
    constexpr float rim = 0.05F;
    const auto bar = [&](const Vector2f& from, const Vector2f& to) {
        build.tube({{0, from.x(), from.y()}, {0, to.x(), to.y()}, rim / 2, rim / 2, 4},
                   painted(model.paint));
    };
    const float low = 0.04F;
    const float top = half.height - rim / 2;
    const float wide = half.length - rim / 2;
    bar({-wide, low}, {wide, low});
    bar({wide, low}, {0, top});
    bar({0, top}, {-wide, low});
    for (const float side : {-0.6F, 0.6F})
        build.tube(
            {{-half.width, side * wide, 0.01F}, {half.width, side * wide, 0.01F}, 0.01F, 0.01F, 5},
            painted(black));
}

/// Lying flat.
void add_tyre(Builder& build, const world::PropModel& model) {
    const Half half(model);
    const float h = half.height;
    const float r = half.length;
    build.lathe({0, 0, 0},
                {{0.62F * r, 0.02F},
                 {0.90F * r, 0},
                 {r, 0.2F * h},
                 {r, 0.8F * h},
                 {0.90F * r, h},
                 {0.62F * r, h - 0.02F}},
                28,
                painted(model.paint));
    build.lathe({0, 0, 0},
                {{0.62F * r, h - 0.02F}, {0.58F * r, h / 2}, {0.001F, h / 2 + 0.001F}},
                28,
                painted(0x8c8e90));
}

/// Pallets and crates are of boards, a carton is of six faces.
void add_box_form(Builder& build, const world::PropModel& model) {
    const Half half(model);
    const Finish finish = painted(model.paint);
    const bool boards = model.length > 1;
    if (!boards) {
        build.box({-half.length, -half.width, 0}, {half.length, half.width, half.height}, finish);
        build.box({-half.length, -0.03F, half.height},
                  {half.length, 0.03F, half.height + 0.001F},
                  painted(0xc9b48a));  // tape
        return;
    }
    const int slats = model.height > 0.5 ? 6 : 1;
    const float slat = half.height / (static_cast<float>(slats) + (slats > 1 ? 0 : 2));
    const auto board = [&](const Vector3f& low, const Vector3f& high) {
        build.box(low, high, finish);
    };
    if (slats == 1) {  // a pallet: deck, blocks, runners
        for (int i = 0; i < 5; ++i) {
            const float y = half.width * (-0.89F + 0.445F * static_cast<float>(i));
            board({-half.length, y - 0.05F, 2 * slat}, {half.length, y + 0.05F, 3 * slat});
        }
        for (const float x : {-0.85F, 0.0F, 0.85F})
            for (const float y : {-0.85F, 0.0F, 0.85F})
                board({x * half.length - 0.07F, y * half.width - 0.05F, 0},
                      {x * half.length + 0.07F, y * half.width + 0.05F, 2 * slat});
        return;
    }
    for (int i = 0; i < slats; ++i) {
        const float z = static_cast<float>(i) * slat;
        const float top = z + 0.86F * slat;
        board({-half.length, -half.width, z}, {half.length, -half.width + 0.02F, top});
        board({-half.length, half.width - 0.02F, z}, {half.length, half.width, top});
        board({-half.length, -half.width, z}, {-half.length + 0.02F, half.width, top});
        board({half.length - 0.02F, -half.width, z}, {half.length, half.width, top});
    }
    board({-half.length, -half.width, half.height - 0.02F}, {half.length, half.width, half.height});
}

}  // namespace

Mesh door_mesh() {
    Mesh mesh;
    Builder build(mesh, Eigen::Isometry3f::Identity());
    build.box({-.5F, -.5F, -.5F}, {.5F, .5F, .08F}, painted(instance_paint));
    build.box({-.5F, -.2F, .08F}, {.3F, .2F, .5F}, painted(0x30383c));  // the pane
    return mesh;
}

Mesh thing_mesh(const world::PropModel& model) {
    Mesh mesh;
    Builder build(mesh, Eigen::Isometry3f::Identity());
    switch (model.form) {
        case world::PropForm::cone:
            add_cone(build, model);
            break;
        case world::PropForm::barrier:
            add_profile(build, model);
            break;
        case world::PropForm::triangle:
            add_triangle(build, model);
            break;
        case world::PropForm::tyre:
            add_tyre(build, model);
            break;
        case world::PropForm::plank: {
            const Half half(model);
            build.box({-half.length, -half.width, 0},
                      {half.length, half.width, half.height},
                      painted(model.paint));
            break;
        }
        case world::PropForm::sign: {
            const Half half(model);
            constexpr float thick = 0.015F;
            build.box({-half.length, -half.length, 0},
                      {half.length, half.length, half.height},
                      painted(model.paint));
            build.box({half.length, -half.width, half.height - 2 * half.width},
                      {half.length + thick, half.width, half.height},
                      painted(white));
            break;
        }
        case world::PropForm::box:
            add_box_form(build, model);
            break;
    }
    return mesh;
}

}  // namespace reprise::render
