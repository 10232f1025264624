#include "render/shapes/street/plant_mesh.h"

#include <cmath>
#include <numbers>

#include "render/shapes/foliage.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::PlantKind;

/// How a kind of plant grows. Heights are shares of the plant's height, widths of the crown's
/// radius.
struct Habit {
    float slenderness;  ///< crown radius over height of a usual one
    float trunk;        ///< radius at the foot
    float low;          ///< where the crown begins
    float wide_at;      ///< share of the crown's height where it is widest
    float taper;  ///< how quickly the crown narrows from there: 1 a cone, 2 a ball, 4 a column
    int boughs;
    float bough;  ///< their radius, the smallest; the largest is 1.5 times as large
    int leaves;
    float leaf;    ///< half the length of the smallest bunch; the largest is 2 times as large
    float core;    ///< how much of a bough is solid: dense crowns hide the sky
    float aspect;  ///< height of a bough over its width: below 1 in layers, above 1 hanging
};

Habit habit_of(PlantKind kind) {
    switch (kind) {
        case PlantKind::lime:
            return {.34F, .075F, .20F, .42F, 2.0F, 20, .32F, 4610, .027F, .76F, 1.0F};
        case PlantKind::birch:
            return {.24F, .060F, .24F, .40F, 1.5F, 22, .24F, 4540, .024F, .42F, 1.5F};
        case PlantKind::poplar:
            return {.14F, .150F, .06F, .35F, 2.6F, 20, .52F, 4610, .043F, .78F, 1.2F};
        case PlantKind::plane:
            return {.46F, .060F, .30F, .50F, 2.3F, 20, .34F, 4540, .027F, .70F, 0.9F};
        case PlantKind::maple:
            return {.42F, .055F, .22F, .45F, 2.8F, 20, .34F, 4540, .027F, .78F, 0.9F};
        case PlantKind::cherry:
            return {.52F, .060F, .28F, .62F, 1.8F, 18, .30F, 4540, .023F, .62F, 0.8F};
        case PlantKind::pine:
            return {.34F, .050F, .46F, .45F, 2.4F, 18, .32F, 4480, .027F, .55F, 0.5F};
        case PlantKind::round_bush:
            return {.62F, 0, .0F, .45F, 2.6F, 12, .46F, 4480, .037F, .86F, 1.0F};
        case PlantKind::tall_bush:
            return {.36F, 0, .0F, .50F, 2.4F, 14, .46F, 4480, .037F, .80F, 1.2F};
        case PlantKind::flowering_bush:
            return {.60F, 0, .0F, .50F, 2.2F, 12, .44F, 4480, .034F, .82F, 1.0F};
        default:
            return {.30F, .085F, .30F, .45F, 2.0F, 17, .30F, 4160, .021F, .78F, 1.0F};
    }
}

float crown_radius(const Habit& habit, float up) {
    const float from = up < habit.wide_at ? (habit.wide_at - up) / habit.wide_at
                                          : (up - habit.wide_at) / (1 - habit.wide_at);
    return std::pow(std::max(0.0F, 1 - std::pow(from, habit.taper)), 0.75F);
}

/// Rings of branches that hang a little, narrower upwards, around a dark core.
Mesh spruce_mesh() {
    HashRandom random(hash(8, 78));
    Mesh mesh;
    constexpr float slenderness = 0.24F;
    const Finish bark{Material::bark};
    add_tube(mesh, {{0, 0, -.03F}, {0, 0, .2F}, .11F, .09F, 8}, bark);
    add_tube(mesh, {{0, 0, .1F}, {0, 0, .99F}, .07F, .004F, 5}, bark);
    add_tube(mesh, {{0, 0, .09F}, {0, 0, .96F}, .52F, .01F, 11}, {Material::leaf, 0});
    smooth(mesh, 1.2);
    constexpr int rings = 15;
    for (int ring = 0; ring < rings; ++ring) {
        const float up = static_cast<float>(ring) / rings;
        const float reach = 0.06F + 0.94F * (1 - up);
        const int fronds = 6 + static_cast<int>(20 * reach);
        for (int i = 0; i < fronds; ++i) {
            const double angle =
                2 * std::numbers::pi * (i + static_cast<double>(random.next())) / fronds;
            const Vector3f out(
                static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0);
            const Vector3f across(-out.y(), out.x(), 0);
            const float own = reach * (0.82F + 0.24F * random.next());
            const float foot = 0.09F + 0.86F * up + 0.03F * random.next();
            // Three cards one after the other, each lower and narrower.
            for (int part = 0; part < 3; ++part) {
                const float from = own * (0.30F + 0.23F * static_cast<float>(part));
                const float to = from + 0.30F * own;
                const float half = own * (0.16F - 0.035F * static_cast<float>(part)) + 0.012F;
                const auto at = [&](float far, float side) {
                    const float hang = 0.30F * far * far / std::max(own, 0.1F) * slenderness +
                                       0.02F * std::abs(side);
                    return Vector3f(far * out + side * across +
                                    Vector3f(0, 0, foot + 0.035F - hang - 0.012F * random.next()));
                };
                const std::uint32_t first = add_vertex(mesh, at(from, -half));
                add_vertex(mesh, at(from + 0.02F, half));
                add_vertex(mesh, at(to, half * .55F));
                add_vertex(mesh, at(to + 0.03F, -half * .55F));
                const Finish leaf{Material::leaf, random.bits()};
                add_triangle(mesh, first, first + 1, first + 2, leaf);
                add_triangle(mesh, first, first + 2, first + 3, leaf);
                const Vector3f normal =
                    Vector3f(out.x(), out.y(), 0.9F / slenderness * 0.3F).normalized();
                mesh.normals.push_back({normal, normal, normal});
                mesh.normals.push_back({normal, normal, normal});
            }
        }
    }
    drop_degenerate(mesh);
    return mesh;
}

}  // namespace

Mesh plant_mesh(PlantKind kind) {
    if (kind == PlantKind::spruce)
        return spruce_mesh();
    const Habit habit = habit_of(kind);
    const auto number = static_cast<std::uint32_t>(kind);
    HashRandom random(hash(number, 77));
    Mesh mesh;
    const Finish bark{Material::bark};
    if (habit.trunk > 0) {
        const float fork = habit.low + .12F;
        add_tube(
            mesh, {{0, 0, -.03F}, {.02F, .01F, fork}, habit.trunk, .62F * habit.trunk, 9}, bark);
        add_tube(mesh,
                 {{.02F, .01F, fork}, {0, .03F, .84F}, .62F * habit.trunk, .2F * habit.trunk, 7},
                 bark);
    }
    std::vector<std::pair<Vector3f, float>> boughs;
    float area = 0;
    for (int i = 0; i < habit.boughs; ++i) {
        const float up =
            (static_cast<float>(i) + 0.7F * random.next()) / static_cast<float>(habit.boughs);
        const double angle = 2.399963 * i + static_cast<double>(random.next());
        const float radius = habit.bough * (1 + 0.5F * random.next());
        const float reach = radius * habit.slenderness * habit.aspect;
        const float away =
            std::max(0.0F, crown_radius(habit, up) - radius) * (0.85F + 0.15F * random.next());
        const float z =
            mix(std::max(habit.low + reach * 0.6F, reach * 0.8F), 1 - reach * 1.02F, up);
        const Vector3f centre(away * static_cast<float>(std::cos(angle)),
                              away * static_cast<float>(std::sin(angle)),
                              z);
        boughs.emplace_back(centre, radius);
        area += radius * radius;
        if (habit.trunk > 0)
            add_tube(mesh,
                     {{0, .02F, std::max(habit.low, z - .16F)},
                      centre,
                      .3F * habit.trunk,
                      .12F * habit.trunk,
                      4},
                     bark);
        add_ellipsoid(
            mesh, centre, Vector3f(radius, radius, reach) * habit.core, 7, {Material::leaf, 0});
    }
    smooth(mesh, 1.2);
    for (const auto& [centre, radius] : boughs)
        add_leaves(mesh,
                   {centre,
                    radius,
                    static_cast<int>(static_cast<float>(habit.leaves) * radius * radius / area),
                    habit.leaf,
                    habit.leaf,
                    habit.slenderness,
                    habit.aspect},
                   random);
    drop_degenerate(mesh);
    return mesh;
}

}  // namespace reprise::render
