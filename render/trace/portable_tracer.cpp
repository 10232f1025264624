// What it must do: say what rays meet, equal on every x86-64 CPU, for any number of threads.
// What it assumes: no fused multiply-add in our own code (cmake/Room.cmake); rays are looked up in
//   packets of 8 that start and run alike, else it is slow.
// How it goes: boxes, in single precision and a little too wide, sort out most instances and most
// of
//   their triangles; the rest are tested in double precision in the mesh's own frame. Additions,
//   multiplications and divisions only: IEEE 754 defines each bit of them.
// What it keeps: nothing between calls.
#include "render/trace/portable_tracer.h"

#include <algorithm>

#include "render/trace/bundle.h"
#include "render/trace/instance.h"
#include "render/trace/ray.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr std::size_t lanes = Bundle::lanes;

/// The box around a mesh in its place.
Box placed_box(const Instance& instance, const Box& bound) {
    Box box;
    for (int corner = 0; corner < 8; ++corner) {
        const Vector3f local((corner & 1) != 0 ? bound.high.x() : bound.low.x(),
                             (corner & 2) != 0 ? bound.high.y() : bound.low.y(),
                             (corner & 4) != 0 ? bound.high.z() : bound.low.z());
        box.add((instance.pose * local.cast<double>()).cast<float>());
    }
    return widened(box);
}

std::vector<Box> placed_boxes(std::span<const Instance> instances) {
    std::vector<Box> boxes;
    for (const Instance& instance : instances)
        boxes.push_back(placed_box(instance, instance.prototype->plain_tree->bound()));
    return boxes;
}

/// What the rays of a bundle have met so far.
struct Nearest {
    std::array<double, lanes> distance;
    std::array<Hit, lanes> hits;

    void take(std::size_t lane,
              const TriangleHits& found,
              std::uint32_t instance,
              std::uint32_t triangle) {
        Hit& hit = hits[lane];
        const double next = found.distance[lane];
        const bool tied =
            next == distance[lane] &&
            (instance < hit.instance || (instance == hit.instance && triangle < hit.triangle));
        if (!(next < distance[lane] || tied))
            return;
        distance[lane] = next;
        hit = {static_cast<float>(next),
               instance,
               triangle,
               static_cast<float>(found.u[lane]),
               static_cast<float>(found.v[lane])};
    }
};

/// Wide enough that boxes with what is exactly as far are still met. [lengths of the direction]
float reach(double distance) {
    return static_cast<float>(distance) * 1.000001F;
}

/// The rays from the one numbered `first` on, and which lanes hold one that can be looked up.
Bundle bundle_of(std::span<const Ray> rays, std::size_t first) {
    Bundle bundle;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Ray& ray = rays[std::min(first + lane, rays.size() - 1)];
        const bool counts = first + lane < rays.size() && is_valid(ray);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto row = static_cast<Eigen::Index>(axis);
            bundle.origin[axis][lane] = counts ? static_cast<double>(ray.origin[row]) : 0;
            bundle.direction[axis][lane] = counts ? static_cast<double>(ray.direction[row]) : 1;
        }
        bundle.masks[lane] = ray.mask;
        bundle.packet.far[lane] = counts ? ray.far : -1;
    }
    bundle.prepare();
    return bundle;
}

template <typename Work>
void for_lanes(unsigned set, const Work& work) {
    for (; set != 0; set &= set - 1)
        work(static_cast<std::size_t>(__builtin_ctz(set)));
}

/// The rays of `wanted` lanes in the frame of a mesh. Lengths along a ray stay what they are.
void move(const Bundle& world,
          const PortableTracer::Placed& placed,
          unsigned wanted,
          Bundle& local) {
    for (std::size_t row = 0; row < 3; ++row) {
        const std::array<double, 4>& m = placed.to_mesh[row];
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            local.origin[row][lane] = m[0] * world.origin[0][lane] + m[1] * world.origin[1][lane] +
                                      m[2] * world.origin[2][lane] + m[3];
            local.direction[row][lane] = m[0] * world.direction[0][lane] +
                                         m[1] * world.direction[1][lane] +
                                         m[2] * world.direction[2][lane];
        }
    }
    for (std::size_t lane = 0; lane < lanes; ++lane)
        local.packet.far[lane] = (wanted >> lane & 1U) != 0 ? world.packet.far[lane] : -1;
    local.prepare();
}

}  // namespace

/// Calls `reach = take(lane, found, instance, triangle)` for each hit found: how far the
/// ray of this lane is of interest from now on.
template <typename Take>
void PortableTracer::walk(Bundle& world, const Take& take) const {
    if (before_ != nullptr)
        before_->walk(world, take);
    TriangleHits found;
    Bundle moved;
    tree_.walk(world.packet, [&](std::uint32_t place, std::uint32_t, unsigned met) {
        const std::uint32_t index = tree_.order()[place];
        const Placed& thing = placed_[index];
        const unsigned wanted = met & world.lanes_matching(thing.mask);
        if (wanted == 0)
            return;
        if (thing.moved)
            move(world, thing, wanted, moved);
        Bundle& local = thing.moved ? moved : world;
        thing.mesh->tree().walk(
            local.packet, [&](std::uint32_t first, std::uint32_t last, unsigned lanes_met) {
                for (std::uint32_t i = first; i < last; ++i) {
                    const MeshTree::Triangle& triangle = thing.mesh->triangles()[i];
                    for_lanes(intersect_triangle(triangle, local, lanes_met & wanted, found),
                              [&](std::size_t lane) {
                                  const float far =
                                      take(lane, found, first_ + index, triangle.number);
                                  local.packet.far[lane] = far;
                                  world.packet.far[lane] = far;
                              });
                }
            });
    });
}

PortableTracer::PortableTracer(std::span<const Instance> instances, const PortableTracer* before)
    : before_(before),
      first_(before == nullptr
                 ? 0
                 : before->first_ + static_cast<std::uint32_t>(before->placed_.size())),
      tree_(placed_boxes(instances), 1) {
    placed_.reserve(instances.size());
    for (const Instance& instance : instances) {
        Placed& placed = placed_.emplace_back();
        placed.mesh = instance.prototype->plain_tree.get();
        placed.mask = instance.mask;
        placed.moved = instance.pose.matrix() != Eigen::Matrix4d::Identity();
        const Eigen::Affine3d to_mesh = instance.pose.inverse();
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column)
                placed.to_mesh[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
                    to_mesh(row, column);
    }
}

void PortableTracer::trace_nearest(std::span<const Ray> rays, std::span<Hit> hits) const {
    for (std::size_t first = 0; first < rays.size(); first += lanes) {
        Bundle bundle = bundle_of(rays, first);
        Nearest nearest;
        for (std::size_t lane = 0; lane < lanes; ++lane)
            nearest.distance[lane] = static_cast<double>(bundle.packet.far[lane]);
        walk(bundle,
             [&](std::size_t lane,
                 const TriangleHits& found,
                 std::uint32_t instance,
                 std::uint32_t triangle) {
                 nearest.take(lane, found, instance, triangle);
                 return reach(nearest.distance[lane]);
             });
        for (std::size_t lane = 0; lane < lanes && first + lane < rays.size(); ++lane)
            hits[first + lane] = nearest.hits[lane];
    }
}

void PortableTracer::trace_visibility(std::span<const Ray> rays,
                                      std::span<std::uint8_t> visible) const {
    for (std::size_t first = 0; first < rays.size(); first += lanes) {
        Bundle bundle = bundle_of(rays, first);
        unsigned blocked = 0;
        walk(bundle,
             [&](std::size_t lane, const TriangleHits& found, std::uint32_t, std::uint32_t) {
                 const float far = rays[first + lane].far;
                 const bool blocks = found.distance[lane] <= static_cast<double>(far);
                 blocked |= static_cast<unsigned>(blocks) << lane;
                 // One thing in the way is enough.
                 return (blocked >> lane & 1U) != 0 ? -1 : far;
             });
        for (std::size_t lane = 0; lane < lanes && first + lane < rays.size(); ++lane)
            visible[first + lane] = static_cast<std::uint8_t>(rays[first + lane].far >= 0 &&
                                                              (blocked >> lane & 1U) == 0);
    }
}

}  // namespace reprise::render
