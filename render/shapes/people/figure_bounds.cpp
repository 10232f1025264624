#include "render/shapes/people/figure_bounds.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "render/shapes/cars/two_wheeler.h"
#include "render/shapes/people/figure.h"
#include "world/check.h"

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

/// Of somebody who rides, for a few of the ways in which he may sit and be dressed.
void extend_by_rider(Eigen::AlignedBox3d& bounds, const CarShape& shape) {
    const world::WalkerModel& model = rider_of(shape.style);
    std::vector<Vertices> vertices;
    for (std::size_t i = 0; i < figure_part_shapes; ++i)
        vertices.push_back(figure_part_mesh(static_cast<Shape>(i), model).vertices);
    constexpr double steered = 0.2;  // [rad] to either side: more is for manoeuvres at a walk
    for (const double steering : {-steered, 0.0, steered})
        for (std::uint32_t look = 0; look < 8; ++look)
            for (const FigurePart& part :
                 rider(shape, outfit_of(model, look), steering, look * std::numbers::pi / 4))
                for (const Eigen::Vector3f& vertex : vertices[static_cast<std::size_t>(part.shape)])
                    bounds.extend(part.pose * vertex.cast<double>());
}

/// Empty boxes for what nobody rides.
std::vector<Eigen::AlignedBox3d> all_ridden_bounds() {
    std::vector<Eigen::AlignedBox3d> all;
    for (const world::VehicleModel& model : world::vehicle_models()) {
        Eigen::AlignedBox3d& bounds = all.emplace_back();
        if (!world::is_two_wheeler(model.body))
            continue;
        const double rear = -model.rear_overhang;
        bounds.extend(Eigen::Vector3d(rear, -model.width / 2, 0));
        bounds.extend(Eigen::Vector3d(rear + model.length, model.width / 2, model.height));
        extend_by_rider(bounds, CarShape(model));
    }
    return all;
}

}  // namespace

const Eigen::AlignedBox3d& ridden_bounds(std::uint16_t model) {
    static const std::vector<Eigen::AlignedBox3d> all = all_ridden_bounds();
    REPRISE_CHECK(model < all.size() && !all[model].isEmpty(), "model " + std::to_string(model));
    return all[model];
}

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
