#pragma once

#include "render/ranging/echo.h"

namespace reprise::render {

/// What a surface does with a LiDAR's pulse at 905 nm.
struct Reflectance {
    float diffuse = 0.3F;    ///< Lambert's share; above 1 for what throws light back to its source
    float roughness = 0.3F;  ///< [rad] of Oren and Nayar's facets
    bool soaks = false;      ///< holds a film of water when it is wet
};

Reflectance reflectance_of(const Scene& scene, const Echo& echo);

/// Of a pulse that meets a surface under an angle with this cosine, the share that comes back, in
/// that of a white surface met straight on. Oren and Nayar (1994) for light that returns to its
/// source: rho (A cos + B sin^2), so that rough asphalt is still seen under grazing angles.
/// `wetness` in [0, 1]: so much of it lies under a film of water, which mirrors light away twice
/// (Fresnel), and what is left spreads over n^2.
float returned_share(const Reflectance& surface, float cosine, float wetness);

/// Of a surface that mirrors radio waves of 77 GHz as many small facets: its radar cross section
/// for each square metre across the beam, met straight on. Chosen so that a car from behind has
/// 10 m^2, somebody on foot 0.3 m^2.
float radar_share(const Scene& scene, const Echo& echo);

}  // namespace reprise::render
