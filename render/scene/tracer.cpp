#include "render/scene/tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <embree3/rtcore.h>
#include <emmintrin.h>
#include <tbb/parallel_for.h>

#include "render/trace/default_float_mode.h"

namespace reprise::render {

namespace {

constexpr std::size_t lanes = 8;  // packets of 16 with instances hang on AVX-512: never use them

// So many packets are filled before the first of them is traced: Embree reads eight lanes at once,
// and has to wait for what was stored lane by lane just before.
constexpr std::size_t ahead = 8;

template <typename Rays>
struct FilledPacket {
    alignas(32) Rays rays;
    alignas(32) std::array<int, lanes> valid;
    bool any;
};

/// Four numbers, one of each of four rays.
struct FourRays {
    explicit FourRays(const std::array<const Ray*, 4>& rays) {
        // A ray is eight numbers in a row: two quarters, turned from rows into columns.
        static_assert(sizeof(Ray) == 8 * sizeof(float) && offsetof(Ray, mask) == 28);
        const auto quarter = [&](std::size_t i, int first) {
            return _mm_loadu_ps(reinterpret_cast<const float*>(rays[i]) + first);
        };
        org_x = quarter(0, 0), org_y = quarter(1, 0), org_z = quarter(2, 0), dir_x = quarter(3, 0);
        _MM_TRANSPOSE4_PS(org_x, org_y, org_z, dir_x);
        dir_y = quarter(0, 4), dir_z = quarter(1, 4), far = quarter(2, 4), mask = quarter(3, 4);
        _MM_TRANSPOSE4_PS(dir_y, dir_z, far, mask);
    }

    /// All bits of those that is_valid() takes.
    __m128i valid() const {
        const auto within = [](__m128 x) {
            return _mm_cmplt_ps(_mm_andnot_ps(_mm_set1_ps(-0.0F), x), _mm_set1_ps(1e18F));
        };
        const __m128 squared = dir_x * dir_x + (dir_y * dir_y + dir_z * dir_z);
        const __m128 places = _mm_and_ps(_mm_and_ps(within(org_x), within(org_y)), within(org_z));
        const __m128 ways = _mm_and_ps(_mm_and_ps(within(dir_x), within(dir_y)), within(dir_z));
        const __m128 lengths = _mm_and_ps(_mm_cmpgt_ps(squared, _mm_set1_ps(1e-12F)),
                                          _mm_cmpge_ps(far, _mm_setzero_ps()));
        return _mm_castps_si128(_mm_and_ps(_mm_and_ps(places, ways), lengths));
    }

    __m128 org_x, org_y, org_z, dir_x, dir_y, dir_z, far, mask;
};

/// In a direction along an axis of the world Embree's coherent packets lose all of their rays.
__m128 off_axis(__m128 components) {
    const __m128 sign = _mm_set1_ps(-0.0F);
    const __m128 least = _mm_set1_ps(1e-12F);
    const __m128 on_axis = _mm_cmplt_ps(_mm_andnot_ps(sign, components), least);
    return _mm_or_ps(_mm_and_ps(on_axis, _mm_or_ps(least, _mm_and_ps(sign, components))),
                     _mm_andnot_ps(on_axis, components));
}

template <typename Packet>
void fill_lanes(Packet& packet, std::size_t lane, const FourRays& rays) {
    _mm_store_ps(&packet.org_x[lane], rays.org_x);
    _mm_store_ps(&packet.org_y[lane], rays.org_y);
    _mm_store_ps(&packet.org_z[lane], rays.org_z);
    _mm_store_ps(&packet.dir_x[lane], off_axis(rays.dir_x));
    _mm_store_ps(&packet.dir_y[lane], off_axis(rays.dir_y));
    _mm_store_ps(&packet.dir_z[lane], off_axis(rays.dir_z));
    _mm_store_ps(&packet.tnear[lane], _mm_setzero_ps());
    _mm_store_ps(&packet.tfar[lane], rays.far);
    _mm_store_ps(&packet.time[lane], _mm_setzero_ps());
    _mm_store_ps(reinterpret_cast<float*>(&packet.mask[lane]), rays.mask);
    std::fill_n(&packet.id[lane], 4, 0U);
    std::fill_n(&packet.flags[lane], 4, 0U);
}

/// The rays from the one numbered `first` on; -1 in `valid` for those to trace. Says whether there
/// are any.
template <typename Packet>
bool fill_packet(Packet& packet,
                 std::array<int, lanes>& valid,
                 std::span<const Ray> rays,
                 std::size_t first) {
    int any = 0;
    for (std::size_t lane = 0; lane < lanes; lane += 4) {
        const auto ray = [&](std::size_t i) {
            return &rays[std::min(first + lane + i, rays.size() - 1)];
        };
        const FourRays four({ray(0), ray(1), ray(2), ray(3)});
        fill_lanes(packet, lane, four);
        // Beyond the last ray there are copies of it.
        const int left = static_cast<int>(rays.size() - std::min(first + lane, rays.size()));
        const __m128i there = _mm_cmplt_epi32(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(left));
        const __m128i traced = _mm_and_si128(four.valid(), there);
        _mm_store_si128(reinterpret_cast<__m128i*>(&valid[lane]), traced);
        any |= _mm_movemask_epi8(traced);
    }
    return any != 0;
}

RTCIntersectContext context_of(bool coherent) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

/// Looks up who is there at this tick, ahead of what of the town was met already, and tells what
/// each lane met as the number of its instance.
std::array<std::uint32_t, lanes> nearer_of_tick(const Scene& scene,
                                                const std::array<int, lanes>& valid,
                                                RTCIntersectContext& context,
                                                RTCRayHit8& packet) {
    // Embree numbers the instances of each tree from 0: a lane whose instance changed met another.
    static_assert(RTC_INVALID_GEOMETRY_ID == no_instance);
    std::array<std::uint32_t, lanes> numbers;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        numbers[lane] = packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID
                            ? no_instance
                            : packet.hit.instID[0][lane];
        packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    if (scene.tree() == nullptr)
        return numbers;
    rtcIntersect8(valid.data(), scene.tree(), &context, &packet);
    const auto of_town = static_cast<std::uint32_t>(scene.town().instances().size());
    for (std::size_t lane = 0; lane < lanes; ++lane)
        if (packet.hit.instID[0][lane] != RTC_INVALID_GEOMETRY_ID)
            numbers[lane] = of_town + packet.hit.instID[0][lane];
    return numbers;
}

void trace_packet(const Scene& scene,
                  RTCIntersectContext& context,
                  FilledPacket<RTCRayHit8>& filled,
                  std::span<Hit> hits) {
    std::fill(hits.begin(), hits.end(), Hit{});
    if (!filled.any)
        return;
    RTCRayHit8& packet = filled.rays;
    rtcIntersect8(filled.valid.data(), scene.town_tree(), &context, &packet);
    const std::array<std::uint32_t, lanes> numbers =
        nearer_of_tick(scene, filled.valid, context, packet);
    for (std::size_t lane = 0; lane < hits.size(); ++lane)
        if (filled.valid[lane] != 0 && numbers[lane] != no_instance)
            hits[lane] = {packet.ray.tfar[lane],
                          numbers[lane],
                          packet.hit.primID[lane],
                          packet.hit.u[lane],
                          packet.hit.v[lane]};
}

/// Half of all rays that a picture needs are short, and begin where nobody is near.
bool may_meet_somebody(const CrowdMap& crowd, const RTCRay8& packet, std::size_t lane) {
    const float x = packet.dir_x[lane];
    const float y = packet.dir_y[lane];
    const float z = packet.dir_z[lane];
    const float far = packet.tfar[lane];
    constexpr float longest = CrowdMap::reach * CrowdMap::reach;
    return !(far * far * (x * x + y * y + z * z) < longest) ||
           crowd.is_near(packet.org_x[lane], packet.org_y[lane]);
}

void occlude_packet(const Scene& scene,
                    RTCIntersectContext& context,
                    FilledPacket<RTCRay8>& filled,
                    std::span<std::uint8_t> visible) {
    RTCRay8& packet = filled.rays;
    // Embree sets tfar to minus infinity where the way is blocked.
    if (filled.any)
        rtcOccluded8(filled.valid.data(), scene.town_tree(), &context, &packet);
    bool open = false;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (packet.tfar[lane] < 0)
            filled.valid[lane] = 0;
        open = open || (filled.valid[lane] != 0 && may_meet_somebody(scene.crowd(), packet, lane));
    }
    if (open && scene.tree() != nullptr)
        rtcOccluded8(filled.valid.data(), scene.tree(), &context, &packet);
    for (std::size_t lane = 0; lane < visible.size(); ++lane)
        visible[lane] = static_cast<std::uint8_t>(packet.tfar[lane] >= 0);
}

}  // namespace

void trace_nearest(const Scene& scene,
                   std::span<const Ray> rays,
                   bool coherent,
                   std::span<Hit> hits) {
    if (scene.portable_tracer() != nullptr)
        return scene.portable_tracer()->trace_nearest(rays, hits);
    RTCIntersectContext context = context_of(coherent);
    std::array<FilledPacket<RTCRayHit8>, ahead> packets;
    for (std::size_t batch = 0; batch < rays.size(); batch += ahead * lanes) {
        const std::size_t count = std::min(ahead, (rays.size() - batch + lanes - 1) / lanes);
        for (std::size_t i = 0; i < count; ++i) {
            RTCHit8& hit = packets[i].rays.hit;
            std::fill_n(hit.geomID, lanes, RTC_INVALID_GEOMETRY_ID);
            std::fill_n(hit.instID[0], lanes, RTC_INVALID_GEOMETRY_ID);
            packets[i].any =
                fill_packet(packets[i].rays.ray, packets[i].valid, rays, batch + i * lanes);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t first = batch + i * lanes;
            trace_packet(scene,
                         context,
                         packets[i],
                         hits.subspan(first, std::min(lanes, rays.size() - first)));
        }
    }
}

void trace_visibility(const Scene& scene,
                      std::span<const Ray> rays,
                      bool coherent,
                      std::span<std::uint8_t> visible) {
    if (scene.portable_tracer() != nullptr)
        return scene.portable_tracer()->trace_visibility(rays, visible);
    RTCIntersectContext context = context_of(coherent);
    std::array<FilledPacket<RTCRay8>, ahead> packets;
    for (std::size_t batch = 0; batch < rays.size(); batch += ahead * lanes) {
        const std::size_t count = std::min(ahead, (rays.size() - batch + lanes - 1) / lanes);
        for (std::size_t i = 0; i < count; ++i)
            packets[i].any =
                fill_packet(packets[i].rays, packets[i].valid, rays, batch + i * lanes);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t first = batch + i * lanes;
            occlude_packet(scene,
                           context,
                           packets[i],
                           visible.subspan(first, std::min(lanes, rays.size() - first)));
        }
    }
}

PlacedTriangle::PlacedTriangle(const Instance& instance, std::uint32_t triangle) {
    const Mesh& mesh = instance.prototype->mesh;
    const std::array<std::uint32_t, 3>& corners = mesh.triangles[triangle];
    a = mesh.vertices[corners[0]].cast<double>();
    to_b = mesh.vertices[corners[1]].cast<double>() - a;
    to_c = mesh.vertices[corners[2]].cast<double>() - a;
    if (!instance.moved)
        return;
    a = instance.pose * a;
    to_b = instance.pose.linear() * to_b;
    to_c = instance.pose.linear() * to_c;
}

namespace {

/// Finds hits again in double precision from the triangles' own corners: equal ids give equal bits,
/// whatever Embree's arithmetic was. Neighbours mostly met the same triangle: one is remembered.
class Refinement {
  public:
    Refinement(const Scene& scene, const Eigen::Vector3d& origin)
        : scene_(scene),
          origin_(origin) {}

    /// In lengths of `direction`.
    float distance(const Hit& hit, const Eigen::Vector3d& direction) {
        if (hit.instance != instance_ || hit.triangle != triangle_) {
            const PlacedTriangle placed(scene_.instance(hit.instance), hit.triangle);
            normal_ = placed.to_b.cross(placed.to_c);
            above_ = normal_.dot(placed.a - origin_);
            instance_ = hit.instance;
            triangle_ = hit.triangle;
        }
        const auto found = static_cast<double>(hit.distance);
        const double distance = above_ / normal_.dot(direction);
        // At grazing angles the plane's equation is ill-conditioned: Embree's distance is kept.
        return std::abs(distance - found) <= 1e-3 + 1e-2 * found ? static_cast<float>(distance)
                                                                 : hit.distance;
    }

  private:
    const Scene& scene_;
    const Eigen::Vector3d origin_;
    std::uint32_t instance_ = no_instance;
    std::uint32_t triangle_ = 0;
    Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();  // of any length
    double above_ = 0;                                  // of the plane over the origin, likewise
};

}  // namespace

void trace_primary(const Scene& scene,
                   const Camera& camera,
                   std::uint32_t mask,
                   std::vector<Hit>& hits) {
    const int width = camera.width();
    const int height = camera.height();
    hits.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const int columns = (width + tile - 1) / tile;
    const int rows = (height + tile - 1) / tile;
    tbb::parallel_for(0, columns * rows, [&](int index) {
        const DefaultFloatMode plain;
        std::array<Ray, tile * tile> rays;
        std::array<Eigen::Vector3d, tile * tile> directions;
        std::array<std::size_t, tile * tile> pixels;
        std::array<Hit, tile * tile> found;
        std::size_t count = 0;  // fewer at the right and lower edge
        const Eigen::Vector2i corner(index % columns * tile, index / columns * tile);
        const Eigen::Vector3f origin = camera.position().cast<float>();
        for (int i = 0; i < tile * tile; ++i) {
            const Eigen::Vector2i pixel = corner + tile_pixel(i);
            if (pixel.x() >= width || pixel.y() >= height)
                continue;
            // Number by number: who copies two at once that were just written one by one waits
            // until they have arrived in memory, which cost a hundredth of a picture.
            const Eigen::Vector3d way = camera.ray(pixel.x() + 0.5, pixel.y() + 0.5);
            const double x = way.x();
            const double y = way.y();
            const double z = way.z();
            directions[count] = {x, y, z};
            pixels[count] = static_cast<std::size_t>(pixel.y() * width + pixel.x());
            Ray& ray = rays[count];
            ray.origin = origin;
            ray.direction = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
            ray.far = std::numeric_limits<float>::infinity();
            ray.mask = mask;
            ++count;
        }
        trace_nearest(scene, std::span(rays).first(count), true, std::span(found).first(count));
        Refinement refinement(scene, camera.position());
        for (std::size_t i = 0; i < count; ++i) {
            const Hit& hit = found[i];
            const float distance = hit.instance != no_instance
                                       ? refinement.distance(hit, directions[i])
                                       : hit.distance;
            hits[pixels[i]] = {distance, hit.instance, hit.triangle, hit.u, hit.v};
        }
    });
}

}  // namespace reprise::render
