#include "render/shapes/foliage.h"

#include <cmath>
#include <numbers>

namespace reprise::render {

using Eigen::Vector3f;

Vector3f HashRandom::direction() {
    const float z = 2 * next() - 1;
    const double angle = 2 * std::numbers::pi * static_cast<double>(next());
    const float wide = std::sqrt(1 - z * z);
    return {
        wide * static_cast<float>(std::cos(angle)), wide * static_cast<float>(std::sin(angle)), z};
}

void add_leaves(Mesh& mesh, const LeafBunch& bunch, HashRandom& random) {
    const auto in_bough = [&](const Vector3f& round) {
        return Vector3f(round.x(), round.y(), round.z() * bunch.slenderness * bunch.aspect);
    };
    const auto stretched = [&](const Vector3f& round) {
        return Vector3f(round.x(), round.y(), round.z() * bunch.slenderness);
    };
    for (int i = 0; i < bunch.count; ++i) {
        const Vector3f out = random.direction();
        const float depth = 0.70F + 0.42F * random.next();
        const Vector3f place = bunch.centre + in_bough(bunch.radius * depth * out);
        // A leaf bunch lies about across its direction outwards, so that it covers the bough.
        const Vector3f lean = (out + 0.9F * random.direction()).normalized();
        const Vector3f u = lean.unitOrthogonal();
        const Vector3f v = lean.cross(u);
        const float size = bunch.smallest + bunch.spread * random.next();
        const float turn = 6.2831853F * random.next();
        const Vector3f along = std::cos(turn) * u + std::sin(turn) * v;
        const Vector3f across = lean.cross(along);
        // Pointed ahead, widest behind its middle, folded along its rib: no square.
        const std::uint32_t first = add_vertex(mesh, place + stretched(size * 1.15F * along));
        add_vertex(mesh, place + stretched(size * (0.56F * across - 0.30F * along - 0.22F * lean)));
        add_vertex(mesh, place - stretched(size * 0.75F * along));
        add_vertex(mesh, place - stretched(size * (0.56F * across + 0.30F * along + 0.22F * lean)));
        const Finish leaf{Material::leaf, random.bits()};
        add_triangle(mesh, first, first + 1, first + 2, leaf);
        add_triangle(mesh, first, first + 2, first + 3, leaf);
        // Lit as the round bough that it belongs to; as after stretching, see Instance.
        const Vector3f normal = Vector3f(out.x() + 0.35F * lean.x(),
                                         out.y() + 0.35F * lean.y(),
                                         (out.z() + 0.35F * lean.z()) / bunch.slenderness)
                                    .normalized();
        mesh.normals.push_back({normal, normal, normal});
        mesh.normals.push_back({normal, normal, normal});
    }
}

}  // namespace reprise::render
