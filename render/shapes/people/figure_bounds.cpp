#include "render/shapes/people/figure_bounds.h"

#include <algorithm>
#include <vector>

#include "render/shapes/people/figure.h"

namespace reprise::render {

namespace {

using Shape = FigurePart::Shape;
using Vertices = std::vector<Eigen::Vector3f>;

/// Of every part's mesh; of trunk and hem every model's.
struct PartVertices {
    std::vector<Vertices> shared{figure_part_shapes};
    std::vector<Vertices> trunks;
    std::vector<Vertices> hems;

    PartVertices() {
        const auto models = world::walker_models();
        for (std::size_t i = 0; i < figure_part_shapes; ++i)
            shared[i] = figure_part_mesh(static_cast<Shape>(i), models.front()).vertices;
        for (const world::WalkerModel& model : models) {
            trunks.push_back(figure_part_mesh(Shape::trunk, model).vertices);
            hems.push_back(figure_part_mesh(Shape::hem, model).vertices);
        }
    }

    const Vertices& of(Shape shape, std::size_t model) const {
        return shape == Shape::trunk ? trunks[model]
               : shape == Shape::hem ? hems[model]
                                     : shared[static_cast<std::size_t>(shape)];
    }
};

}  // namespace

Eigen::AlignedBox3d figure_bounds(const world::WalkerModel& model,
                                  const world::WalkerState& walker,
                                  bool rains) {
    static const PartVertices vertices;
    Eigen::AlignedBox3d bounds;
    for (const FigurePart& part : figure(model, walker, rains))
        for (const Eigen::Vector3f& vertex : vertices.of(part.shape, walker.model()))
            bounds.extend(part.pose * vertex.cast<double>());
    bounds.min().z() =
        std::max(bounds.min().z(), 0.0);  // who lies on a rucksack sinks into the ground
    return bounds;
}

}  // namespace reprise::render
