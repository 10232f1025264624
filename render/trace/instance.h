#pragma once

#include <cstdint>
#include <memory>

#include <Eigen/Geometry>

#include "render/shapes/fast_math.h"
#include "render/shapes/mesh.h"
#include "render/trace/mesh_tree.h"

struct RTCSceneTy;

namespace reprise::render {

/// What kind of thing an instance is: how its triangles are painted and which class they have.
enum class Kind : std::uint8_t {
    ground,
    marking,
    town,
    tree,
    plant,
    prop,
    parked,  ///< a car's body that nobody drives
    car_body,
    wheel,
    pedestrian,
    rider,
    thing  ///< a scenario's prop
};

struct ReleaseTree {
    void operator()(RTCSceneTy* tree) const;
};

/// A mesh with a tree over it, Embree's or our own, placed by any number of instances.
struct Prototype {
    Mesh mesh;
    std::unique_ptr<RTCSceneTy, ReleaseTree> tree;
    std::unique_ptr<MeshTree> plain_tree;
    double radius = 0;  ///< [m] from the mesh's origin to its farthest corner
};

/// A prototype in its place.
struct Instance {
    const Prototype* prototype = nullptr;
    Kind kind = Kind::town;
    Material material = Material::skin;  ///< of a figure's part
    std::uint16_t lamps = 0;             ///< Lamp bits of a car
    std::uint16_t model = 0;             ///< of a car; kind of a plant; value of a prop
    std::uint16_t outfit = 0;            ///< of a figure's part: index in Scene::outfits()
    std::uint32_t look = 0;              ///< of a car, see world::Look
    Color color{0.5F, 0.5F, 0.5F};       ///< of a car's paint
    std::uint32_t style = 0;             ///< of plants and props: seeds what is left open
    std::uint32_t actor = 0;             ///< 0: part of the town
    std::uint32_t thing = 0;             ///< of the town: 1 + its number in world::TownThings, or 0
    std::uint32_t mask = 1;              ///< rays with a common bit see it
    bool moved = false;                  ///< by its pose: else the mesh is in the scene's frame
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();  ///< to the scene's frame
    Eigen::Matrix3f normal_to_scene = Eigen::Matrix3f::Identity();
};

inline constexpr std::uint32_t solid_bit = 1;
inline constexpr std::uint32_t marking_bit = 2;  ///< paint casts no shadow

}  // namespace reprise::render
