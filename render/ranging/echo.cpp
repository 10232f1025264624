#include "render/ranging/echo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/scene/tracer.h"

namespace reprise::render {

namespace {

constexpr std::size_t at_once = 256;

/// That a triangle lies in, in the scene's frame.
struct Plane {
    const Instance* instance = nullptr;
    std::uint32_t triangle = 0;
    Eigen::Vector3d a;
    Eigen::Vector3d normal;  ///< of any length
    double length = 0;       ///< of the normal

    Plane() = default;

    Plane(const Instance& its_instance, std::uint32_t its_triangle)
        : instance(&its_instance),
          triangle(its_triangle) {
        const PlacedTriangle placed(its_instance, its_triangle);
        a = placed.a;
        normal = placed.to_b.cross(placed.to_c);
        length = normal.norm();
    }
};

/// In double precision, as pictures are. `last` is the plane that a neighbour met: often this one
/// meets it, too. Written where it stays, number by number: who copies several at once that were
/// just written one by one waits until they have arrived in memory, a twelfth of a sweep.
void find_echo(const Scene& scene, const Hit& hit, const Beam& beam, Plane& last, Echo& echo) {
    echo.hit.distance = hit.distance;
    echo.hit.instance = hit.instance;
    echo.hit.triangle = hit.triangle;
    echo.hit.u = hit.u;
    echo.hit.v = hit.v;
    if (hit.instance == no_instance) {
        echo.instance = nullptr;
        echo.distance = std::numeric_limits<double>::infinity();
        echo.cosine = 0;
        return;
    }
    echo.instance = &scene.instance(hit.instance);
    if (last.instance != echo.instance || last.triangle != hit.triangle)
        last = Plane(*echo.instance, hit.triangle);
    const double along = last.normal.dot(beam.direction);
    const auto found = static_cast<double>(hit.distance);
    const double distance = last.normal.dot(last.a - beam.origin) / along;
    // At grazing angles the plane's equation is ill-conditioned: the tracer's distance is kept.
    echo.distance = std::abs(distance - found) <= 1e-3 + 1e-2 * found ? distance : found;
    echo.cosine = static_cast<float>(std::min(1.0, std::abs(along) / last.length));
}

}  // namespace

void find_echoes(const Scene& scene,
                 std::span<const Beam> beams,
                 double range,
                 std::uint32_t mask,
                 std::span<Echo> echoes) {
    std::array<Ray, at_once> rays;
    std::array<Hit, at_once> hits;
    Plane last;
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
            find_echo(scene, hits[i], beams[first + i], last, echoes[first + i]);
    }
}

Eigen::Vector3d normal_of(const Echo& echo, const Beam& beam) {
    const Plane plane(*echo.instance, echo.hit.triangle);
    return plane.normal / (plane.normal.dot(beam.direction) > 0 ? -plane.length : plane.length);
}

}  // namespace reprise::render
