#pragma once

#include <array>

#include "render/look/sky.h"
#include "render/look/wet.h"
#include "render/scene/scene.h"
#include "render/scene/tracer.h"
#include "world/hash.h"

namespace reprise::render {

/// A place on a surface where a ray ended.
struct Surface {
    Eigen::Vector3f position;  ///< scene
    Eigen::Vector3f local;     ///< in the prototype's frame (a car's, a wheel's)
    Eigen::Vector3f flat;      ///< the triangle's normal, towards the viewer
    Eigen::Vector3f normal;    ///< smoothed, towards the viewer
    Eigen::Vector3f local_normal;
    Eigen::Vector3f view;  ///< unit vector from the eye to the place
    float distance;        ///< [m] from the eye
    float footprint;       ///< [m] how much of the surface a pixel covers, the longer way
    Material material;
    std::uint32_t tag;
    const Instance* instance;
    // How the weather is here: less below a roof or a bridge. See expose().
    float wetness = 0;
    float snow = 0;
};

/// What a surface does with light at one place.
struct Look {
    Color albedo = Color::Constant(0.5F);
    Color emission = Color::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
    float f0 = 0.04F;        ///< mirrors this share of what comes straight on
    float gloss = 0;         ///< how much of the mirrored world is seen as a picture, [0, 1]
    float roughness = 0.8F;  ///< spread of the sun's highlight
    float translucency = 0;  ///< share of light that passes through, for leaves
};

/// What shading depends on beside the surface itself.
struct ShadingInput {
    const Scene& scene;
    const Sky& sky;
    std::uint64_t tick;
};

/// Says what lies where rays from one eye ended. Neighbours mostly met the same triangle: what all
/// of it has in common is remembered.
class Surfaces {
  public:
    /// `pixel`: size of a pixel one metre ahead [m].
    Surfaces(const Scene& scene, const Eigen::Vector3f& eye, float pixel)
        : scene_(scene),
          eye_(eye),
          pixel_(pixel) {}

    Surface at(const Hit& hit, const Eigen::Vector3f& direction);

    /// Asks for what at() will read of a hit's triangle: first for its numbers, then for its
    /// corners. Triangles lie in memory in no order that rays meet.
    void expect(const Hit& hit) const;
    void expect_corners(const Hit& hit) const;

  private:
    void take_facet(const Hit& hit);

    /// A triangle in its place.
    struct Facet {
        std::uint32_t number = no_instance;  ///< of its instance
        std::uint32_t triangle = 0;
        const Instance* instance = nullptr;
        std::array<Eigen::Vector3f, 3> corners;                  ///< in the prototype's frame
        const std::array<Eigen::Vector3f, 3>* smooth = nullptr;  ///< normals at them; none: flat
        Eigen::Vector3f local_normal;                            ///< of a flat one
        Eigen::Vector3f normal;                                  ///< likewise, scene
        Eigen::Vector3f flat;                                    ///< scene
        Material material;
        std::uint32_t tag;
    };

    const Scene& scene_;
    Eigen::Vector3f eye_;
    float pixel_;
    Facet facet_;
};

/// Says how wet the place is, and how much snow lies there.
void expose(const ShadingInput& input, Surface& surface);

Look shade_surface(const ShadingInput& input, const Surface& surface);

/// As given by the class of what was hit; `sky` for none. Depends on ids only.
world::SemanticClass semantic_class(const Scene& scene, const Hit& hit);

// One for each kind of surface, in files of their own.
Look ground_look(const ShadingInput& input, const Surface& surface);
Look building_look(const ShadingInput& input, const Surface& surface);
Look model_building_look(const ShadingInput& input, const Surface& surface);
Look prop_look(const ShadingInput& input, const Surface& surface);
Look plot_look(const ShadingInput& input, const Surface& surface);
Look plant_leaf_look(const Surface& surface);
Look plant_bark_look(const Surface& surface);
Look car_look(const ShadingInput& input, const Surface& surface);
Look car_part_look(const ShadingInput& input, const Surface& surface);
Look wheel_look(const ShadingInput& input, const Surface& surface);
Look walker_look(const ShadingInput& input, const Surface& surface);

/// Covers what faces the sky, as far as the weather says.
void lay_snow(Look& look, const ShadingInput& input, const Surface& surface);

// Likewise: what class a prop's or plot's triangle has.
world::SemanticClass prop_class(std::uint32_t tag);
world::SemanticClass plot_class(world::PlotKind kind);

/// How far a car's low beam and tail lamps are on, [0, 1]: as recorded, and in pictures that are
/// made darker than the run was, as drivers would have them.
inline float low_beam(std::uint16_t lamps, const Sky& sky) {
    return (lamps & world::lamp_low_beam) != 0 ? 1.0F : sky.headlamps();
}

/// Lamps flash 1.5 times a second, each vehicle's since an instant of its own: ticks are 50 ms.
inline bool flashes_now(std::uint64_t tick, std::uint32_t actor) {
    return (tick * 3 + world::hash(actor, 61) % 40) % 40 < 22;
}

/// How far the room behind a window is lit: each lights up at a dusk of its own. `fate` in [0, 1)
/// says whether at all, with the chance `share`.
inline float room_light(const Sky& sky, float fate, float share) {
    if (fate >= share || sky.lamplight() <= 0)
        return 0;
    const float start = 0.7F * fate / share;
    return smooth_step(start, start + 0.3F, sky.lamplight());
}

/// Wet walls and roofs are darker and smoother, their panes are not. `wetness` in [0, 1].
inline void soak_masonry(Look& look, float wetness) {
    if (look.gloss > 0)
        return;
    look.albedo = soaked(look.albedo, 0.6F * wetness);
    look.roughness = mix(look.roughness, 0.35F, wetness);
}

/// How much detail of this size [m] a pixel can show: 1 all, 0 none. Fading what is smaller than a
/// pixel to its mean is what keeps textures from flickering.
inline float detail(const Surface& surface, float size) {
    return 1 - smooth_step(0.25F * size, 0.9F * size, surface.footprint);
}

}  // namespace reprise::render
