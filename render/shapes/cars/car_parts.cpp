#include "render/shapes/cars/car_parts.h"

#include <algorithm>

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::Livery;

void add_part_box(Mesh& mesh, const Vector3f& low, const Vector3f& high, CarPart part) {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.translation() = 0.5F * (low + high);
    add_box(mesh, pose, 0.5F * (high - low), part_finish(part));
}

}  // namespace

void add_service_parts(Mesh& mesh, const CarShape& shape) {
    const Livery livery = shape.model->livery;
    const float x = shape.rear + 0.52F * shape.length();
    if (livery == Livery::taxi) {
        const float z = shape.top(x) - 0.02F;
        add_part_box(mesh, {x - .07F, -.20F, z}, {x + .07F, .20F, z + .035F}, CarPart::rubber);
        add_part_box(
            mesh, {x - .06F, -.21F, z + .03F}, {x + .06F, .21F, z + .15F}, CarPart::roof_sign);
    }
    if (livery == Livery::police || livery == Livery::ambulance) {
        const float at = livery == Livery::police ? x : shape.rear + 0.60F * shape.length();
        const float z = shape.top(at) - 0.02F;
        const float half = livery == Livery::police ? .52F : .68F;
        add_part_box(mesh, {at - .11F, -half, z}, {at + .11F, half, z + .05F}, CarPart::rubber);
        for (const float side : {-1.0F, 1.0F}) {
            const float inner = side * .16F;
            const float outer = side * half;
            add_part_box(mesh,
                         {at - .10F, std::min(inner, outer), z + .045F},
                         {at + .10F, std::max(inner, outer), z + .125F},
                         CarPart::blue_lamp);
        }
        add_part_box(
            mesh, {at - .09F, -.15F, z + .045F}, {at + .09F, .15F, z + .115F}, CarPart::chrome);
    }
    if (livery == Livery::ambulance) {
        const float back = shape.rear + 0.25F;
        const float z = shape.top(back) - 0.02F;
        add_part_box(
            mesh, {back - .08F, -.45F, z}, {back + .08F, .45F, z + .09F}, CarPart::blue_lamp);
    }
}

}  // namespace reprise::render
