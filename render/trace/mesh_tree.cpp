#include "render/trace/mesh_tree.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr std::size_t leaf_size = 4;

std::vector<Box> triangle_boxes(const Mesh& mesh) {
    std::vector<Box> boxes;
    boxes.reserve(mesh.triangles.size());
    for (const std::array<std::uint32_t, 3>& corners : mesh.triangles) {
        Box box;
        for (const std::uint32_t corner : corners)
            box.add(mesh.vertices[corner]);
        boxes.push_back(widened(box));
    }
    return boxes;
}

}  // namespace

MeshTree::MeshTree(const Mesh& mesh) : tree_(triangle_boxes(mesh), leaf_size) {
    triangles_.reserve(mesh.triangles.size());
    for (const std::uint32_t number : tree_.order()) {
        Triangle& triangle = triangles_.emplace_back();
        triangle.number = number;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vector3f& vertex = mesh.vertices[mesh.triangles[number][corner]];
            triangle.corners[corner] = {vertex.x(), vertex.y(), vertex.z()};
        }
    }
    bound_ = tree_.bound();
}

}  // namespace reprise::render
