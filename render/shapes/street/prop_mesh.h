#pragma once

#include "render/shapes/mesh.h"
#include "world/town_generated.h"

namespace reprise::render {

/// What a part of a prop is made of.
enum class PropFinish : std::uint8_t {
    steel,  ///< galvanised
    iron,   ///< painted dark
    plate,  ///< a sign's face
    plate_back,
    lamp,  ///< shines at dusk
    timber,
    concrete,
    masonry,
    coping,
    paint,  ///< by style
    glass,
    water,
    foliage
};

/// Material::prop is tagged with these.
struct PropTag {
    world::PropKind kind;
    PropFinish finish;
    std::uint32_t centre_mm = 0;  ///< height of a sign's middle over the foot

    std::uint32_t bits() const {
        return static_cast<std::uint32_t>(kind) | (static_cast<std::uint32_t>(finish) << 8u) |
               (centre_mm << 16u);
    }

    static PropTag of(std::uint32_t bits) {
        return {static_cast<world::PropKind>(bits & 0xffu),
                static_cast<PropFinish>((bits >> 8u) & 0xffu),
                bits >> 16u};
    }
};

/// Half the width of a sign's face. [m]
inline constexpr float sign_radius = 0.32F;

/// Along x, across and upwards. [m]
struct PropSize {
    float length;
    float width;
    float height;
};

/// The size that a prop gets; what its maker left at 0 is that of a usual one.
PropSize size_of(const world::Prop& prop);

/// A prop of this size in its own frame, see world/town.fbs. Not for parked vehicles. 12 to 3,000
/// triangles; without normals, but for hedges.
Mesh prop_mesh(world::PropKind kind, const PropSize& size);

// One for each family, in files of their own.
void add_sign(Mesh& mesh, world::PropKind kind, const PropSize& size);
void add_street_light(Mesh& mesh, const PropSize& size);
void add_barrier(Mesh& mesh, world::PropKind kind, const PropSize& size);
void add_street_furniture(Mesh& mesh, world::PropKind kind, const PropSize& size);

}  // namespace reprise::render
