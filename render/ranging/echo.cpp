#include "render/ranging/echo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/scene/tracer.h"

namespace reprise::render {

namespace {

constexpr std::size_t at_once = 256;

/// As refined_distance, and with the normal, which it takes the same way to.
Echo echo_of(const Scene& scene, const Hit& hit, const Beam& beam) {
    Echo echo;
    echo.hit = hit;
    echo.instance = &scene.instance(hit.instance);
    const PlacedTriangle placed(*echo.instance, hit.triangle);
    const Eigen::Vector3d normal = placed.to_b.cross(placed.to_c);
    const double along = normal.dot(beam.direction);
    const auto found = static_cast<double>(hit.distance);
    const double distance = normal.dot(placed.a - beam.origin) / along;
    // At grazing angles the plane's equation is ill-conditioned: the tracer's distance is kept.
    echo.distance = std::abs(distance - found) <= 1e-3 + 1e-2 * found ? distance : found;
    const double length = normal.norm();
    echo.normal = normal / (along > 0 ? -length : length);
    echo.cosine = static_cast<float>(std::min(1.0, std::abs(along) / length));
    return echo;
}

}  // namespace

void find_echoes(const Scene& scene,
                 std::span<const Beam> beams,
                 double range,
                 std::uint32_t mask,
                 std::span<Echo> echoes) {
    std::array<Ray, at_once> rays;
    std::array<Hit, at_once> hits;
    for (std::size_t first = 0; first < beams.size(); first += at_once) {
        const std::size_t count = std::min(at_once, beams.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const Beam& beam = beams[first + i];
            rays[i] = {beam.origin.cast<float>(),
                       beam.direction.cast<float>(),
                       static_cast<float>(range),
                       mask};
        }
        trace_nearest(scene, std::span(rays).first(count), true, std::span(hits).first(count));
        for (std::size_t i = 0; i < count; ++i)
            echoes[first + i] = hits[i].instance == no_instance
                                    ? Echo()
                                    : echo_of(scene, hits[i], beams[first + i]);
    }
}

}  // namespace reprise::render
