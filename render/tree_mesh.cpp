#include <cmath>
#include <numbers>

#include "render/noise.h"
#include "render/town_mesh.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// Crown radius over height of a usual tree: keeps leaves and trunk round after stretching.
constexpr float slenderness = 0.3F;

/// Numbers in [0, 1) one after the other.
class Draws {
  public:
    explicit Draws(std::uint32_t seed) : seed_(seed) {}

    float next() { return unit(hash(seed_, count_++)); }

    std::uint32_t bits() { return hash(seed_, count_++); }

    Vector3f direction() {
        const float z = 2 * next() - 1;
        const double angle = 2 * std::numbers::pi * static_cast<double>(next());
        const float wide = std::sqrt(1 - z * z);
        return {wide * static_cast<float>(std::cos(angle)),
                wide * static_cast<float>(std::sin(angle)),
                z};
    }

  private:
    std::uint32_t seed_;
    std::uint32_t count_ = 0;
};

struct Crown {
    float low;      ///< share of the height
    float wide_at;  ///< share of the crown's height where it is widest
    int boughs;
};

/// In units of the crown radius across, of the height upwards.
Vector3f stretched(const Vector3f& round) {
    return {round.x(), round.y(), round.z() * slenderness};
}

void set_normal(Mesh& mesh, const Vector3f& normal) {
    mesh.normals.push_back({normal, normal, normal});
}

/// Flat-shaded parts get their corner normals before the leaves bring their own.
void fill_normals(Mesh& mesh) {
    smooth(mesh, 1.2);
}

void add_leaves(Mesh& mesh, const Vector3f& centre, float radius, int count, Draws& draws) {
    for (int i = 0; i < count; ++i) {
        const Vector3f out = draws.direction();
        const float depth = 0.70F + 0.42F * draws.next();
        const Vector3f place = centre + stretched(radius * depth * out);
        // A leaf bunch lies about across its direction outwards, so that it covers the bough.
        const Vector3f lean = (out + 0.9F * draws.direction()).normalized();
        const Vector3f u = lean.unitOrthogonal();
        const Vector3f v = lean.cross(u);
        const float size = 0.036F + 0.042F * draws.next();
        const float turn = 6.2831853F * draws.next();
        const Vector3f along = std::cos(turn) * u + std::sin(turn) * v;
        const Vector3f across = lean.cross(along);
        const std::uint32_t first = add_vertex(mesh, place + stretched(size * along));
        add_vertex(mesh, place + stretched(size * 0.62F * across));
        add_vertex(mesh, place - stretched(size * along));
        add_vertex(mesh, place - stretched(size * 0.62F * across));
        const Finish leaf{Material::leaf, draws.bits()};
        add_triangle(mesh, first, first + 1, first + 2, leaf);
        add_triangle(mesh, first, first + 2, first + 3, leaf);
        // Lit as the round bough that it belongs to; as after stretching, see Instance.
        const Vector3f normal = Vector3f(out.x() + 0.35F * lean.x(),
                                         out.y() + 0.35F * lean.y(),
                                         (out.z() + 0.35F * lean.z()) / slenderness);
        set_normal(mesh, normal.normalized());
        set_normal(mesh, normal.normalized());
    }
}

}  // namespace

Mesh tree_mesh(std::uint32_t kind) {
    constexpr std::array<Crown, 3> crowns{{{.30F, .45F, 17}, {.16F, .38F, 20}, {.36F, .55F, 15}}};
    const Crown crown = crowns[kind % crowns.size()];
    Draws draws(hash(kind, 77));
    Mesh mesh;
    const Finish bark{Material::bark};
    add_tube(mesh, {{0, 0, -.03F}, {.02F, .01F, crown.low + .12F}, .085F, .055F, 9}, bark);
    add_tube(mesh, {{.02F, .01F, crown.low + .12F}, {0, .03F, .8F}, .055F, .02F, 7}, bark);
    std::vector<std::pair<Vector3f, float>> boughs;
    for (int i = 0; i < crown.boughs; ++i) {
        const float up =
            (static_cast<float>(i) + 0.7F * draws.next()) / static_cast<float>(crown.boughs);
        const double angle = 2.399963 * i + static_cast<double>(draws.next());
        const float bulge =
            1 - std::pow(std::abs(up - crown.wide_at) /
                             (up < crown.wide_at ? crown.wide_at : 1 - crown.wide_at),
                         2.0F);
        const float radius = 0.30F + 0.16F * draws.next();
        const float away =
            std::max(0.0F, (1 - radius) * (0.25F + 0.75F * bulge)) * (0.8F + 0.2F * draws.next());
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
        add_leaves(mesh, centre, radius, static_cast<int>(1050 * radius), draws);
    drop_degenerate(mesh);
    return mesh;
}

}  // namespace reprise::render
