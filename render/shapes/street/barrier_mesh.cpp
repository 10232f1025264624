#include <algorithm>

#include "render/shapes/builder.h"
#include "render/shapes/foliage.h"
#include "render/shapes/street/prop_mesh.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::PropKind;

/// Posts every 2.5 m, two rails, and pales between them.
void add_fence(Builder& build, const PropSize& size) {
    const Finish timber{Material::prop, PropTag{PropKind::fence, PropFinish::paint}.bits()};
    const float half = 0.5F * size.length;
    const int panels = std::max(1, static_cast<int>(size.length / 2.5F + 0.5F));
    for (int i = 0; i <= panels; ++i) {
        const float x =
            mix(-half + .04F, half - .04F, static_cast<float>(i) / static_cast<float>(panels));
        build.box({x - .04F, -.04F, -.2F}, {x + .04F, .04F, size.height + .06F}, timber);
    }
    for (const float z : {.22F, size.height - .2F})
        build.box({-half, .005F, z - .035F}, {half, .03F, z + .035F}, timber);
    const int pales = std::max(2, static_cast<int>(size.length / 0.155F));
    for (int i = 0; i < pales; ++i) {
        const float x =
            mix(-half, half, (static_cast<float>(i) + 0.5F) / static_cast<float>(pales));
        const float low = .08F;
        const float high = size.height - .05F;
        // Boards with points: both faces, and the edges that are seen from the street.
        for (const float y : {-.018F, .004F}) {
            const bool front = y < 0;
            const Vector3f a(x - .042F, y, low);
            const Vector3f b(x + .042F, y, low);
            const Vector3f c(x + .042F, y, high);
            const Vector3f d(x - .042F, y, high);
            const Vector3f tip(x, y, high + .05F);
            build.quad(
                front ? std::array<Vector3f, 4>{a, b, c, d} : std::array<Vector3f, 4>{b, a, d, c},
                timber);
            build.triangle(
                front ? std::array<Vector3f, 3>{d, c, tip} : std::array<Vector3f, 3>{c, d, tip},
                timber);
        }
        for (const float side : {-.042F, .042F})
            build.quad({Vector3f(x + side, .004F, low),
                        Vector3f(x + side, -.018F, low),
                        Vector3f(x + side, -.018F, high),
                        Vector3f(x + side, .004F, high)},
                       timber);
    }
}

void add_wall(Builder& build, const PropSize& size) {
    const Finish masonry{Material::prop, PropTag{PropKind::wall, PropFinish::masonry}.bits()};
    const Finish coping{Material::prop, PropTag{PropKind::wall, PropFinish::coping}.bits()};
    const float half = 0.5F * size.length;
    const float y = 0.5F * size.width;
    build.box({-half, -y, -.3F}, {half, y, size.height - .08F}, masonry);
    build.box({-half, -y - .04F, size.height - .08F}, {half, y + .04F, size.height}, coping);
    const int piers = static_cast<int>(size.length / 4);
    for (int i = 0; i <= piers && size.height > .9F; ++i) {
        const float reach = half - .22F;
        const float x = piers == 0
                            ? -reach
                            : mix(-reach, reach, static_cast<float>(i) / static_cast<float>(piers));
        build.box({x - .22F, -y - .05F, -.3F}, {x + .22F, y + .05F, size.height + .02F}, masonry);
        build.box({x - .26F, -y - .09F, size.height + .02F},
                  {x + .26F, y + .09F, size.height + .10F},
                  coping);
    }
}

/// A dark block in a coat of leaves. Brings normals.
void add_hedge(Mesh& mesh, Builder& build, const PropSize& size) {
    const PropTag tag{PropKind::hedge, PropFinish::foliage};
    const Finish leaf{Material::prop, tag.bits()};
    const Vector3f half(0.5F * size.length, 0.5F * size.width, 0.5F * size.height);
    build.box({-half.x() + .08F, -half.y() + .08F, -.1F},
              {half.x() - .08F, half.y() - .08F, size.height - .08F},
              leaf);
    smooth(mesh, 0.3);
    HashRandom random(hash(static_cast<std::uint32_t>(size.length * 10), 81));
    const float area = 2 * size.height * (size.length + size.width) + size.length * size.width;
    const int leaves = std::min(2600, static_cast<int>(area * 95));
    for (int i = 0; i < leaves; ++i) {
        // A place on one of the five faces, by their areas.
        const float pick = random.next() * area;
        const float s = 2 * random.next() - 1;
        const float t = random.next();
        Vector3f place;
        Vector3f out;
        if (pick < size.length * size.width) {
            place = {s * half.x(), (2 * t - 1) * half.y(), size.height};
            out = {0, 0, 1};
        } else {
            const bool end = pick > area - 2 * size.height * size.width;
            const float side = random.next() < 0.5F ? -1.0F : 1.0F;
            place = end ? Vector3f(side * half.x(), s * half.y(), t * size.height)
                        : Vector3f(s * half.x(), side * half.y(), t * size.height);
            out = end ? Vector3f(side, 0, 0) : Vector3f(0, side, 0);
        }
        place -= out * (.02F + .09F * random.next());
        const Vector3f lean = (out + 1.1F * random.direction()).normalized();
        const float length = .05F + .045F * random.next();
        const Vector3f u = lean.unitOrthogonal() * length;
        const Vector3f v = lean.cross(u) * 0.62F;
        const std::uint32_t first = add_vertex(mesh, place + u);
        add_vertex(mesh, place + v);
        add_vertex(mesh, place - u);
        add_vertex(mesh, place - v);
        const Finish own{Material::prop, tag.bits() | (random.bits() & 0xffff0000u)};
        add_triangle(mesh, first, first + 1, first + 2, own);
        add_triangle(mesh, first, first + 2, first + 3, own);
        const Vector3f normal = (out + 0.5F * lean).normalized();
        mesh.normals.push_back({normal, normal, normal});
        mesh.normals.push_back({normal, normal, normal});
    }
}

}  // namespace

void add_barrier(Mesh& mesh, PropKind kind, const PropSize& size) {
    Builder build(mesh, Eigen::Isometry3f::Identity());
    if (kind == PropKind::fence)
        add_fence(build, size);
    else if (kind == PropKind::wall)
        add_wall(build, size);
    else
        add_hedge(mesh, build, size);
}

}  // namespace reprise::render
