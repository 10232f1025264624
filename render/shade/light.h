#pragma once

#include <vector>

#include "render/look/look.h"

namespace reprise::render {

/// What arrives at a place.
struct Light {
    float sun_visibility = 1;         ///< share of the sun's disc that is seen
    float sky_visibility = 1;         ///< share of the sky that is not hidden by things near
    Color reflected = Color::Zero();  ///< radiance from where a mirror would show
};

/// A car's head lamps, for the light that they throw on the road.
struct Beam {
    Eigen::Vector3f position;
    Eigen::Vector3f ahead;  ///< unit vector
};

/// The beams of the cars nearest to the eye, in the order of the instances; none by day.
std::vector<Beam> find_beams(const ShadingInput& input, const Eigen::Vector3f& eye);

/// Where a mirror lying there would show: never into the surface itself.
Eigen::Vector3f mirror_direction(const Eigen::Vector3f& view,
                                 const Eigen::Vector3f& normal,
                                 const Eigen::Vector3f& flat);

/// Radiance of a lit place towards the eye, without what is between them.
Color outgoing_radiance(const ShadingInput& input,
                        const std::vector<Beam>& beams,
                        const Look& look,
                        const Light& light,
                        const Eigen::Vector3f& position,
                        const Eigen::Vector3f& view);

/// Fog, dust and the veil of rain and snow over a distance. [m] `from` in the scene's frame.
Color through_atmosphere(const Sky& sky,
                         const Color& radiance,
                         const Eigen::Vector3f& from,
                         const Eigen::Vector3f& view,
                         float distance);

}  // namespace reprise::render
