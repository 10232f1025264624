#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>

namespace reprise::render {

/// Directions need not be unit vectors; distances count in their lengths.
struct Ray {
    Eigen::Vector3f origin;
    Eigen::Vector3f direction;
    float far;
    std::uint32_t mask;
};

inline constexpr std::uint32_t no_instance = 0xffffffffu;

/// What a ray met first.
struct Hit {
    float distance = 0;                    ///< in lengths of the ray's direction
    std::uint32_t instance = no_instance;  ///< number of a Scene.instance(), or none: sky
    std::uint32_t triangle = 0;
    float u = 0;  ///< weight of the triangle's second corner
    float v = 0;  ///< of its third
};

/// Embree asserts that rays are numbers, and would end the process: others are not looked up.
inline bool is_valid(const Ray& ray) {
    constexpr float most = 1e18F;
    const auto within = [](const Eigen::Vector3f& v) {
        return std::abs(v.x()) < most && std::abs(v.y()) < most && std::abs(v.z()) < most;
    };
    return within(ray.origin) && within(ray.direction) && ray.direction.squaredNorm() > 1e-12F &&
           ray.far >= 0;
}

}  // namespace reprise::render
