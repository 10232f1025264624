#include "render/shapes/builder.h"

#include <cmath>
#include <numbers>

namespace reprise::render {

using Eigen::Vector2f;
using Eigen::Vector3f;

void Builder::box(const Vector3f& low, const Vector3f& high, Finish finish, unsigned without) {
    Eigen::Isometry3f middle = pose_;
    middle.translation() = pose_ * Vector3f(0.5F * (low + high));
    add_box(mesh_, middle, 0.5F * (high - low), finish, without);
}

void Builder::quad(const std::array<Vector3f, 4>& corners, Finish finish) {
    add_quad(mesh_,
             {pose_ * corners[0], pose_ * corners[1], pose_ * corners[2], pose_ * corners[3]},
             finish);
}

void Builder::triangle(const std::array<Vector3f, 3>& corners, Finish finish) {
    const std::uint32_t first = add_vertex(mesh_, pose_ * corners[0]);
    add_vertex(mesh_, pose_ * corners[1]);
    add_vertex(mesh_, pose_ * corners[2]);
    add_triangle(mesh_, first, first + 1, first + 2, finish);
}

void Builder::tube(const Tube& tube, Finish finish) {
    add_tube(mesh_,
             {pose_ * tube.from, pose_ * tube.to, tube.radius_from, tube.radius_to, tube.sides},
             finish);
}

void Builder::plate(const std::vector<Vector3f>& corners,
                    float thickness,
                    Finish top,
                    Finish rest) {
    const Vector3f down(0, 0, -thickness);
    for (std::size_t i = 2; i < corners.size(); ++i) {
        triangle({corners[0], corners[i - 1], corners[i]}, top);
        triangle({corners[0] + down, corners[i] + down, corners[i - 1] + down}, rest);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3f& from = corners[i];
        const Vector3f& to = corners[(i + 1) % corners.size()];
        quad({from + down, to + down, to, from}, rest);
    }
}

void Builder::frustum(const Vector3f& foot, float low, float high, float height, Finish finish) {
    const std::array<Vector2f, 4> plan{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    const auto at = [&](std::size_t corner, float half, float z) {
        const Vector2f& p = plan[corner % 4];
        return Vector3f(foot + Vector3f(half * p.x(), half * p.y(), z));
    };
    for (std::size_t i = 0; i < 4; ++i)
        quad({at(i, low, 0), at(i + 1, low, 0), at(i + 1, high, height), at(i, high, height)},
             finish);
    quad({at(0, high, height), at(1, high, height), at(2, high, height), at(3, high, height)},
         finish);
}

void Builder::lathe(const Vector3f& foot,
                    const std::vector<Vector2f>& profile,
                    int sides,
                    Finish finish) {
    std::vector<std::vector<Vector3f>> rings;
    for (const Vector2f& point : profile) {
        std::vector<Vector3f>& ring = rings.emplace_back();
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            const Vector3f p(point.x() * static_cast<float>(std::cos(angle)),
                             point.x() * static_cast<float>(std::sin(angle)),
                             point.y());
            ring.push_back(pose_ * Vector3f(foot + p));
        }
    }
    add_loft(mesh_, rings, true, finish);
}

}  // namespace reprise::render
