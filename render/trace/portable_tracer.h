#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/trace/mesh_tree.h"

namespace reprise::render {

struct Bundle;
struct Hit;
struct Instance;
struct Ray;

/// Finds what rays meet, like Embree, but with the same bits on every x86-64 CPU: nothing here asks
/// which CPU it runs on. What a ray meets is defined without the tree: of all triangles in its way
/// the one with the least (distance, instance, triangle), in double precision. Twice
/// Embree's time.
class PortableTracer {
  public:
    /// Borrows these instances' prototypes. Rays also meet what is `before`, which is borrowed:
    /// its instances are numbered first.
    explicit PortableTracer(std::span<const Instance> instances,
                            const PortableTracer* before = nullptr);

    /// As the functions of these names in render/scene/tracer.h.
    void trace_nearest(std::span<const Ray> rays, std::span<Hit> hits) const;
    void trace_visibility(std::span<const Ray> rays, std::span<std::uint8_t> visible) const;

    /// An instance, as rays need it.
    struct Placed {
        const MeshTree* mesh;
        std::uint32_t mask;
        bool moved;  ///< false: the mesh is in the scene's frame already
        std::array<std::array<double, 4>, 3> to_mesh;
    };

  private:
    template <typename Take>
    void walk(Bundle& world, const Take& take) const;

    const PortableTracer* before_;
    std::uint32_t first_;  // number of the first instance here
    std::vector<Placed> placed_;
    BoundingVolumes tree_;
};

}  // namespace reprise::render
