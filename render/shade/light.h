#pragma once

#include "render/shade/lamp_light.h"

namespace reprise::render {

/// As a pixel's own visibility, before the mean: its ray was for another one.
inline constexpr float not_asked = -1;

/// What arrives at a place.
struct Light {
    Color reflected = Color::Zero();  ///< radiance from where a mirror would show
    float sun_visibility = 1;         ///< share of the sun's disc that is seen
    float sky_visibility = 1;         ///< share of the sky that is not hidden by things near
    float lamp_visibility = 0;  ///< share of the strongest lamp's, or the moon's, that arrives
    float rest_visibility = 0;  ///< likewise of all other lamps
};

/// Where a mirror lying there would show: never into the surface itself.
Eigen::Vector3f mirror_direction(const Eigen::Vector3f& view,
                                 const Eigen::Vector3f& normal,
                                 const Eigen::Vector3f& flat);

/// Radiance of a lit place towards the eye, without what is between them.
Color outgoing_radiance(const ShadingInput& input,
                        const Look& look,
                        const Light& light,
                        const LampLight& lamps,
                        const Eigen::Vector3f& view);

/// Fog, dust and the veil of rain and snow over a distance. [m] `from` in the scene's frame.
Color through_atmosphere(const Sky& sky,
                         const Color& radiance,
                         const Eigen::Vector3f& from,
                         const Eigen::Vector3f& view,
                         float distance);

}  // namespace reprise::render
