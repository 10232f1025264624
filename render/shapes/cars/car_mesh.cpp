#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/shapes/cars/car_parts.h"
#include "render/shapes/cars/car_shape.h"
#include "render/shapes/fast_math.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

float arch_radius(const CarShape& shape) {
    return shape.wheel_radius() * 1.15F;
}

/// Lower edge of the body: the sill, cut by a half circle around each wheel.
float bottom(const CarShape& shape, float x) {
    const float arch = arch_radius(shape);
    for (const float axle : {0.0F, shape.wheelbase()}) {
        const float from_axle = std::abs(x - axle);
        if (from_axle < arch)
            return shape.wheel_radius() + std::sqrt(arch * arch - from_axle * from_axle);
    }
    // Bumpers rise a little towards the ends.
    const float from_end = std::min(shape.front - x, x - shape.rear);
    return shape.sill + 0.06F * (1 - smooth_step(0, 0.4F, from_end));
}

/// Where the body is cut into slices: even steps, closer at the ends and around the wheel arches.
std::vector<float> stations(const CarShape& shape) {
    std::vector<float> at;
    const float length = shape.front - shape.body_rear;
    const int even = static_cast<int>(length / 0.16F) + 1;
    for (int i = 0; i <= even; ++i)
        at.push_back(shape.body_rear + length * static_cast<float>(i) / static_cast<float>(even));
    for (const float share : {.002F, .004F, .008F, .014F, .02F, .03F, .045F, .06F, .08F}) {
        at.push_back(shape.body_rear + share * shape.length());
        at.push_back(shape.front - share * shape.length());
    }
    for (const float axle : {0.0F, shape.wheelbase()}) {
        for (int i = 0; i <= 18; ++i) {
            const double angle = std::numbers::pi * i / 18;
            at.push_back(axle + arch_radius(shape) * 0.9999F * static_cast<float>(std::cos(angle)));
        }
        at.push_back(axle + arch_radius(shape) + 0.003F);
        at.push_back(axle - arch_radius(shape) - 0.003F);
    }
    std::sort(at.begin(), at.end());
    at.erase(
        std::unique(
            at.begin(), at.end(), [](float last, float next) { return next - last < 0.0015F; }),
        at.end());
    std::erase_if(at, [&](float x) { return x < shape.body_rear || x > shape.front; });
    return at;
}

/// The left half of a slice, from the middle of the floor over the side to the middle of the roof.
std::vector<Vector3f> half_slice(const CarShape& shape, float x) {
    const float belt = shape.belt(x);
    const float low = std::min(bottom(shape, x), belt - 0.03F);
    const float high = shape.top(x);
    const float wide = shape.half_width(x);
    const float side = belt - low;
    std::vector<Vector3f> points{{x, 0, low},
                                 {x, wide - 0.10F, low},
                                 {x, wide * 0.975F, low + 0.008F},
                                 {x, wide * 0.985F, low + 0.25F * side},
                                 {x, wide, low + 0.60F * side},
                                 {x, wide * 0.995F, low + 0.80F * side},
                                 {x, wide * 0.975F, low + 0.95F * side}};
    const float shoulder = wide * mix(0.945F, 0.965F, shape.boxiness);
    constexpr int steps = 12;
    for (int i = 0; i <= steps; ++i) {
        // Superellipse of exponent 4 (roots of a circle's coordinates), towards 8 when boxy.
        const float t = static_cast<float>(i) / steps;
        const float cosine = i == steps ? 0 : std::sqrt((1 - t * t) / (1 + t * t));
        const float sine = std::sqrt(2 * t / (1 + t * t));
        const float out = mix(cosine, std::sqrt(cosine), shape.boxiness);
        const float up = mix(sine, std::sqrt(sine), shape.boxiness) * (high - belt);
        points.emplace_back(x, out * (shoulder - shape.tumble_home * up), belt + up);
    }
    return points;
}

std::vector<Vector3f> slice(const CarShape& shape, float x) {
    std::vector<Vector3f> ring = half_slice(shape, x);
    for (std::size_t i = ring.size() - 1; i-- > 1;)
        ring.emplace_back(ring[i].x(), -ring[i].y(), ring[i].z());
    return ring;
}

std::vector<Vector3f> closing(const std::vector<Vector3f>& ring) {
    Vector3f middle = Vector3f::Zero();
    for (const Vector3f& point : ring)
        middle += point / static_cast<float>(ring.size());
    return std::vector<Vector3f>(ring.size(), middle);
}

void add_span(Mesh& mesh, const Vector3f& low, const Vector3f& high, Finish finish) {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.translation() = 0.5F * (low + high);
    add_box(mesh, pose, 0.5F * (high - low), finish);
}

void add_underbody(Mesh& mesh, const CarShape& shape) {
    const float inner = static_cast<float>(shape.model->track) * 0.5F - 0.16F;
    const Finish black{Material::car_under};
    add_span(mesh,
             {shape.rear + 0.25F, -inner, shape.sill + 0.02F},
             {shape.front - 0.25F, inner, shape.wheel_radius() * 1.9F},
             black);
    for (const float axle : {0.0F, shape.wheelbase()}) {
        const float reach = static_cast<float>(shape.model->track) * 0.5F;
        add_tube(
            mesh,
            {{axle, -reach, shape.wheel_radius()}, {axle, reach, shape.wheel_radius()}, .05F, .05F},
            black);
    }
}

/// On two arms from the front corners.
void add_tall_mirrors(Mesh& mesh, const CarShape& shape) {
    const float x = shape.front - 0.12F;
    const float z = shape.height() * 0.68F;
    const float y = shape.half_width(x) + 0.14F;
    const float back = x - 0.30F;
    const float pillar = 0.85F * shape.half_width(back);  // inside of the body
    for (const float side : {-1.0F, 1.0F}) {
        add_ellipsoid(mesh, {x, side * y, z}, {.06F, .09F, .19F}, 12, {Material::car_body});
        for (const float up : {-.13F, .13F})
            add_tube(mesh,
                     {{back, side * pillar, z + up}, {x, side * y, z + up}, .018F, .018F, 6},
                     part_finish(CarPart::rubber));
    }
}

void add_mirrors(Mesh& mesh, const CarShape& shape) {
    if (shape.style == world::BodyStyle::lorry || shape.style == world::BodyStyle::bus)
        return add_tall_mirrors(mesh, shape);
    const float x = shape.rear + 0.675F * shape.length();
    const float z = shape.belt(x) + 0.075F;
    const float y = shape.half_width(x) + 0.055F;
    for (const float side : {-1.0F, 1.0F}) {
        add_ellipsoid(mesh, {x, side * y, z}, {.065F, .105F, .07F}, 12, {Material::car_body});
        // Its foot stands on the shoulder below the window.
        add_tube(mesh,
                 {{x + .06F, side * 0.88F * shape.half_width(x), z - .13F},
                  {x + .01F, side * y, z},
                  .032F,
                  .022F,
                  8},
                 part_finish(CarPart::rubber));
    }
}

void add_cargo(Mesh& mesh, const CarShape& shape) {
    const float half = static_cast<float>(shape.model->width) * 0.5F;
    const float deck = shape.height() * 0.325F;
    add_span(mesh,
             {shape.rear, -half, deck},
             {shape.body_rear - 0.12F, half, shape.height()},
             {Material::car_cargo});
    const Finish black{Material::car_under};
    add_span(mesh, {shape.rear + .1F, -.45F, .6F}, {shape.front - .6F, .45F, deck}, black);
    // Side guards and the bar that keeps cars from diving under.
    for (const float side : {-1.0F, 1.0F}) {
        const float y = side * (half - 0.08F);
        const float from = arch_radius(shape) + 0.15F;
        const float to = shape.body_rear - 0.5F;
        add_span(mesh, {from, y - .03F, .45F}, {to, y + .03F, .85F}, black);
        for (const float x : {from + .25F, 0.5F * (from + to), to - .25F})
            add_span(mesh, {x - .03F, y - .02F, .5F}, {x + .03F, y + .02F, deck + .02F}, black);
    }
    for (const float y : {-.35F, .35F})
        add_span(mesh,
                 {shape.rear + .07F, y - .03F, .44F},
                 {shape.rear + .13F, y + .03F, deck + .02F},
                 black);
    add_span(
        mesh, {shape.rear + .05F, -half + .1F, .42F}, {shape.rear + .15F, half - .1F, .56F}, black);
}

}  // namespace

Mesh car_body_mesh(const CarShape& shape) {
    Mesh mesh;
    std::vector<std::vector<Vector3f>> rings;
    for (const float x : stations(shape))
        rings.push_back(slice(shape, x));
    rings.insert(rings.begin(), closing(rings.front()));
    rings.push_back(closing(rings.back()));
    add_loft(mesh, rings, true, {Material::car_body});
    add_underbody(mesh, shape);
    add_mirrors(mesh, shape);
    if (shape.style == world::BodyStyle::lorry)
        add_cargo(mesh, shape);
    add_service_parts(mesh, shape);
    drop_degenerate(mesh);
    smooth(mesh, 0.6);
    return mesh;
}

Mesh wheel_mesh(const CarShape& shape) {
    const float radius = shape.wheel_radius();
    const float half = radius > 0.4F ? 0.15F : 0.105F;
    // (share of the radius, y) from the hub's outer side over the tread to the inner side.
    const std::array<Eigen::Vector2f, 9> profile{{{0.0F, half - .035F},
                                                  {.20F, half - .03F},
                                                  {.60F, half - .02F},
                                                  {.68F, half - .006F},
                                                  {.72F, half - .012F},
                                                  {.92F, half},
                                                  {1.0F, half - .03F},
                                                  {1.0F, -half + .03F},
                                                  {0.0F, -half}}};
    std::vector<std::vector<Vector3f>> rings;
    constexpr int sides = 32;
    for (const Eigen::Vector2f& point : profile) {
        std::vector<Vector3f>& ring = rings.emplace_back();
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            ring.emplace_back(point.x() * radius * static_cast<float>(std::cos(angle)),
                              point.y(),
                              point.x() * radius * static_cast<float>(std::sin(angle)));
        }
    }
    Mesh mesh;
    add_loft(mesh, rings, true, {Material::wheel});
    drop_degenerate(mesh);
    smooth(mesh, 0.7);
    return mesh;
}

}  // namespace reprise::render
