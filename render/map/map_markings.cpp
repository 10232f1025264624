#include <cmath>

#include "ground/mesh/ground_probe.h"
#include "render/map/map_layers.h"
#include "world/geometry2d.h"

namespace reprise::render {

namespace {

constexpr double smallest_scale =
    1.2;  ///< [pixels/m] below it lines and arrows are too fine to see
constexpr Ink paint_ink{244, 244, 240};
constexpr Ink arrow_ink{226, 229, 233};

/// Is a place in the open, as seen from above?
bool is_in_the_open(const ground::GroundProbe& probe, const Eigen::Vector3d& p) {
    constexpr double clearance = 1.0;  // [m]
    const auto top = probe.below({p.x(), p.y(), p.z() + 1000});
    return !top || top->z < p.z() + clearance;
}

/// Is something painted in the middle of a lane there, such as an arrow or a crossing?
class Painted {
  public:
    explicit Painted(const ground::GroundMesh& markings) : markings_(&markings) {
        std::vector<world::BoxGrid::Entry> entries;
        for (std::uint32_t i = 0; i < markings.vertices.size(); ++i) {
            world::Box box;
            box.take(markings.vertices[i].head<2>());
            entries.push_back({box, i});
        }
        by_place_ = world::BoxGrid(entries);
    }

    /// Corners of triangles up to 4 m ahead and behind, and 0.9 m to the sides.
    bool around(const world::LanePoint& at) const {
        constexpr double along_reach = 4;
        constexpr double across_reach = 0.9;
        world::Box box;
        box.take(at.position.head<2>(), along_reach);
        const Eigen::Vector2d along(std::cos(at.yaw), std::sin(at.yaw));
        for (const std::uint32_t i : by_place_.near(box)) {
            const Eigen::Vector2d off = (markings_->vertices[i] - at.position).head<2>();
            if (std::abs(off.dot(along)) < along_reach &&
                std::abs(world::cross(along, off)) < across_reach)
                return true;
        }
        return false;
    }

  private:
    const ground::GroundMesh* markings_;
    world::BoxGrid by_place_;
};

/// An arrow head on the lane, pointing the way it goes.
void draw_arrow(const world::LaneT& lane, const world::LanePoint& at, MapCanvas& canvas) {
    const double reach =
        std::clamp(0.28 * lane.width * canvas.pixels_per_metre(), 2.2, 7 * canvas.unit());
    canvas.symbol(at.position.head<2>(),
                  at.yaw,
                  {{reach, 0}, {-reach, 0.75 * reach}, {-0.4 * reach, 0}, {-reach, -0.75 * reach}},
                  arrow_ink);
}

}  // namespace

void draw_markings(const world::TownT& town,
                   const ground::GroundMesh& ground,
                   const ground::GroundMesh& markings,
                   MapCanvas& canvas) {
    if (canvas.pixels_per_metre() < smallest_scale * canvas.unit())
        return;
    const ground::GroundProbe probe(ground);
    for (const auto& [p, q, r] : markings.triangles) {
        const Eigen::Vector3d corners[] = {
            markings.vertices[p], markings.vertices[q], markings.vertices[r]};
        if (is_in_the_open(probe, (corners[0] + corners[1] + corners[2]) / 3))
            canvas.fill({corners[0].head<2>(), corners[1].head<2>(), corners[2].head<2>()},
                        paint_ink);
    }
    const Painted painted(markings);
    const double apart = std::max(24.0, 70 * canvas.unit() / canvas.pixels_per_metre());  // [m]
    for (const world::LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::driving || lane.length < apart / 3)
            continue;
        const int count = std::max(1, static_cast<int>(lane.length / apart));
        for (int i = 0; i < count; ++i) {
            const world::LanePoint at = world::point_at(lane, lane.length * (i + 0.5) / count);
            if (is_in_the_open(probe, at.position) && !painted.around(at))
                draw_arrow(lane, at, canvas);
        }
    }
}

}  // namespace reprise::render
