// What it must do: say where a box in space is in a picture, as far as it is in it: one that
// reaches
//   out of the picture, or behind the camera, has an outline of what can be seen of it.
// How it goes: what is farthest out of a box's image lies on one of its edges, as far as these are
//   in the picture, or in a corner of the picture.
// What it keeps: nothing.
#include "render/labels/box_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace reprise::render {

namespace {

/// What is seen of a box so far; nothing at first.
class Outline {
  public:
    void reach(const Eigen::Vector3d& at) {
        box_.left = std::min(box_.left, at.x());
        box_.top = std::min(box_.top, at.y());
        box_.right = std::max(box_.right, at.x());
        box_.bottom = std::max(box_.bottom, at.y());
    }

    std::optional<PixelBox> within(const Camera& camera) const {
        if (box_.left > box_.right)
            return std::nullopt;
        return PixelBox{std::max(box_.left, 0.0),
                        std::max(box_.top, 0.0),
                        std::min(box_.right, static_cast<double>(camera.width())),
                        std::min(box_.bottom, static_cast<double>(camera.height()))};
    }

  private:
    static constexpr double far = std::numeric_limits<double>::max();
    PixelBox box_{far, far, -far, -far};
};

/// The share of an edge from which on, and that to which, a pinhole has it in its picture: what is
/// there lies on the inner side of five planes, those of the borders and one close to the camera.
std::optional<std::pair<double, double>> part_in_picture(const Camera& camera,
                                                         const Eigen::Vector3d& from_scene,
                                                         const Eigen::Vector3d& to_scene) {
    constexpr double nearest = 1e-3;  // [m]
    const auto inside = [&](const Eigen::Vector3d& p_scene) {
        const Eigen::Vector3d p_camera =
            camera.rotation_scene_camera().transpose() * (p_scene - camera.position());
        const double x = camera.focal() * p_camera.x() + camera.middle().x() * p_camera.z();
        const double y = camera.focal_y() * p_camera.y() + camera.middle().y() * p_camera.z();
        return std::array{x,
                          y,
                          camera.width() * p_camera.z() - x,
                          camera.height() * p_camera.z() - y,
                          p_camera.z() - nearest};
    };
    const auto first = inside(from_scene);
    const auto last = inside(to_scene);
    double from = 0;
    double to = 1;
    for (std::size_t plane = 0; plane < first.size(); ++plane) {
        if (first[plane] < 0 && last[plane] < 0)
            return std::nullopt;
        const double crossed = first[plane] / (first[plane] - last[plane]);
        if (first[plane] < 0)
            from = std::max(from, crossed);
        else if (last[plane] < 0)
            to = std::min(to, crossed);
    }
    if (from > to)
        return std::nullopt;
    return std::pair(from, to);
}

/// Where a lens that bends shows a point, if it lies in the picture and the lens sees so far out.
std::optional<Eigen::Vector3d> place_in_picture(const Camera& camera,
                                                const Eigen::Vector3d& p_scene) {
    const Eigen::Vector3d way = p_scene - camera.position();
    if (!camera.lens().is_fisheye() && way.dot(camera.rotation_scene_camera().col(2)) <= 0)
        return std::nullopt;
    const Eigen::Vector3d at = camera.project(p_scene);
    if (!(at.x() >= 0 && at.x() <= camera.width() && at.y() >= 0 && at.y() <= camera.height()))
        return std::nullopt;
    // Beyond what it sees the picture is continued: there a place has no ray, or another one's.
    const Eigen::Vector3d ray = camera.ray(at.x(), at.y());
    if (ray.isZero(0) || ray.normalized().dot(way.normalized()) < 1 - 1e-6)
        return std::nullopt;
    return at;
}

void reach_along(const Camera& camera,
                 const Eigen::Vector3d& from,
                 const Eigen::Vector3d& to,
                 Outline& outline) {
    const auto along = [&](double share) { return Eigen::Vector3d(from + share * (to - from)); };
    if (camera.lens().is_plain()) {
        if (const auto part = part_in_picture(camera, from, to)) {
            outline.reach(camera.project(along(part->first)));
            outline.reach(camera.project(along(part->second)));
        }
        return;
    }
    constexpr int parts = 64;
    constexpr int halvings = 24;
    auto before = place_in_picture(camera, from);
    for (int i = 0; i <= parts; ++i) {
        const auto here = place_in_picture(camera, along(static_cast<double>(i) / parts));
        if (here)
            outline.reach(*here);
        if (here.has_value() != before.has_value()) {
            double seen = static_cast<double>(here ? i : i - 1) / parts;
            double unseen = static_cast<double>(here ? i - 1 : i) / parts;
            for (int round = 0; round < halvings; ++round) {
                const double middle = (seen + unseen) / 2;
                if (const auto at = place_in_picture(camera, along(middle))) {
                    outline.reach(*at);
                    seen = middle;
                } else {
                    unseen = middle;
                }
            }
        }
        before = here;
    }
}

/// Does a ray from a camera, in the box's own frame, meet it?
bool meets(const Eigen::Vector3d& from, const Eigen::Vector3d& way, const Eigen::Vector3d& size) {
    double first = 0;
    double last = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0) {
            if (std::abs(from[axis]) > size[axis] / 2)
                return false;
            continue;
        }
        const double one = (-size[axis] / 2 - from[axis]) / way[axis];
        const double other = (size[axis] / 2 - from[axis]) / way[axis];
        first = std::max(first, std::min(one, other));
        last = std::min(last, std::max(one, other));
    }
    return first <= last;
}

}  // namespace

std::optional<PixelBox> box_in_picture(const Camera& camera,
                                       const Eigen::Isometry3d& pose_world_box,
                                       const Eigen::Vector3d& size) {
    Outline outline;
    for (int axis = 0; axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge) {
            Eigen::Vector3d from;
            from[axis] = -0.5;
            from[(axis + 1) % 3] = (edge & 1) != 0 ? 0.5 : -0.5;
            from[(axis + 2) % 3] = (edge & 2) != 0 ? 0.5 : -0.5;
            Eigen::Vector3d to = from;
            to[axis] = 0.5;
            reach_along(camera,
                        pose_world_box * Eigen::Vector3d(from.cwiseProduct(size)),
                        pose_world_box * Eigen::Vector3d(to.cwiseProduct(size)),
                        outline);
        }
    // Corners; where a lens ends within the picture there are more of these, and they are round.
    const Eigen::Isometry3d pose_box_world = pose_world_box.inverse();
    const Eigen::Vector3d from = pose_box_world * camera.position();
    const int parts = camera.lens().is_plain() ? 1 : 8;
    for (int row = 0; row <= parts; ++row)
        for (int column = 0; column <= parts; ++column) {
            const Eigen::Vector3d at(static_cast<double>(camera.width()) * column / parts,
                                     static_cast<double>(camera.height()) * row / parts,
                                     0);
            const Eigen::Vector3d ray = camera.ray(at.x(), at.y());
            if (!ray.isZero(0) && meets(from, pose_box_world.linear() * ray, size))
                outline.reach(at);
        }
    return outline.within(camera);
}

}  // namespace reprise::render
