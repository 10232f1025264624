#include <cmath>

#include "render/shapes/foliage.h"
#include "render/shapes/street/plant_mesh.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// Crown radius over height of a usual tree: keeps leaves and trunk round after stretching.
constexpr float slenderness = 0.3F;

struct Crown {
    float low;      ///< share of the height
    float wide_at;  ///< share of the crown's height where it is widest
    int boughs;
};

/// In units of the crown radius across, of the height upwards.
Vector3f stretched(const Vector3f& round) {
    return {round.x(), round.y(), round.z() * slenderness};
}

/// Flat-shaded parts get their corner normals before the leaves bring their own.
void fill_normals(Mesh& mesh) {
    smooth(mesh, 1.2);
}

}  // namespace

Mesh tree_mesh(std::uint32_t kind) {
    constexpr std::array<Crown, 3> crowns{{{.30F, .45F, 17}, {.16F, .38F, 20}, {.36F, .55F, 15}}};
    const Crown crown = crowns[kind % crowns.size()];
    HashRandom random(hash(kind, 77));
    Mesh mesh;
    const Finish bark{Material::bark};
    add_tube(mesh, {{0, 0, -.03F}, {.02F, .01F, crown.low + .12F}, .085F, .055F, 9}, bark);
    add_tube(mesh, {{.02F, .01F, crown.low + .12F}, {0, .03F, .8F}, .055F, .02F, 7}, bark);
    std::vector<std::pair<Vector3f, float>> boughs;
    for (int i = 0; i < crown.boughs; ++i) {
        const float up =
            (static_cast<float>(i) + 0.7F * random.next()) / static_cast<float>(crown.boughs);
        const double angle = 2.399963 * i + static_cast<double>(random.next());
        const float bulge =
            1 - std::pow(std::abs(up - crown.wide_at) /
                             (up < crown.wide_at ? crown.wide_at : 1 - crown.wide_at),
                         2.0F);
        const float radius = 0.30F + 0.16F * random.next();
        const float away =
            std::max(0.0F, (1 - radius) * (0.25F + 0.75F * bulge)) * (0.8F + 0.2F * random.next());
        const float reach = radius * slenderness;
        const float z = mix(crown.low + reach * 0.7F, 1 - reach, up);
        const Vector3f centre(away * static_cast<float>(std::cos(angle)),
                              away * static_cast<float>(std::sin(angle)),
                              z);
        boughs.emplace_back(centre, radius);
        add_tube(mesh, {{0, .02F, std::max(crown.low, z - .16F)}, centre, .028F, .010F, 5}, bark);
        add_ellipsoid(
            mesh, centre, stretched(Vector3f::Constant(radius * 0.78F)), 8, {Material::leaf, 0});
    }
    fill_normals(mesh);
    for (const auto& [centre, radius] : boughs)
        add_leaves(mesh,
                   {centre, radius, static_cast<int>(1050 * radius), 0.036F, 0.042F, slenderness},
                   random);
    drop_degenerate(mesh);
    return mesh;
}

}  // namespace reprise::render
