#include "tests/bench/traced_rays.h"

#include <algorithm>
#include <bit>
#include <vector>

#include <benchmark/benchmark.h>

namespace reprise::bench {

std::vector<TracedPacket>* noted_packets = nullptr;

namespace {

constexpr std::size_t lanes = 8;

/// Trees of moments are released when the next one comes; their packets are traced again later.
void keep(RTCScene scene) {
    static std::vector<RTCScene> kept;
    if (std::find(kept.begin(), kept.end(), scene) != kept.end())
        return;
    rtcRetainScene(scene);
    kept.push_back(scene);
}

TracedPacket noted(const int* valid,
                   RTCScene scene,
                   const RTCIntersectContext& context,
                   const RTCRay8& rays,
                   bool nearest) {
    keep(scene);
    TracedPacket packet{};
    packet.scene = scene;
    packet.nearest = nearest;
    packet.coherent = (context.flags & RTC_INTERSECT_CONTEXT_FLAG_COHERENT) != 0;
    for (std::size_t i = 0; i < lanes; ++i) {
        packet.origin[0][i] = rays.org_x[i];
        packet.origin[1][i] = rays.org_y[i];
        packet.origin[2][i] = rays.org_z[i];
        packet.direction[0][i] = rays.dir_x[i];
        packet.direction[1][i] = rays.dir_y[i];
        packet.direction[2][i] = rays.dir_z[i];
        packet.far[i] = rays.tfar[i];
        packet.mask[i] = rays.mask[i];
        if (valid[i] != 0)
            packet.valid = static_cast<unsigned char>(packet.valid | 1U << i);
    }
    return packet;
}

void fill(const TracedPacket& packet, RTCRay8& rays, std::array<int, lanes>& valid) {
    std::copy_n(packet.origin[0].data(), lanes, rays.org_x);
    std::copy_n(packet.origin[1].data(), lanes, rays.org_y);
    std::copy_n(packet.origin[2].data(), lanes, rays.org_z);
    std::copy_n(packet.direction[0].data(), lanes, rays.dir_x);
    std::copy_n(packet.direction[1].data(), lanes, rays.dir_y);
    std::copy_n(packet.direction[2].data(), lanes, rays.dir_z);
    std::copy_n(packet.far.data(), lanes, rays.tfar);
    std::copy_n(packet.mask.data(), lanes, rays.mask);
    std::fill_n(rays.tnear, lanes, 0.0F);
    std::fill_n(rays.time, lanes, 0.0F);
    std::fill_n(rays.flags, lanes, 0U);
    for (std::size_t i = 0; i < lanes; ++i)
        valid[i] = (packet.valid >> i & 1U) != 0 ? -1 : 0;
}

}  // namespace

void trace_again(std::span<const TracedPacket> packets) {
    alignas(32) RTCRayHit8 packet{};
    alignas(32) std::array<int, lanes> valid{};
    for (const TracedPacket& traced : packets) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = traced.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                        : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        fill(traced, packet.ray, valid);
        if (traced.nearest) {
            std::fill_n(packet.hit.geomID, lanes, RTC_INVALID_GEOMETRY_ID);
            std::fill_n(packet.hit.instID[0], lanes, RTC_INVALID_GEOMETRY_ID);
            rtcIntersect8(valid.data(), traced.scene, &context, &packet);
        } else {
            rtcOccluded8(valid.data(), traced.scene, &context, &packet.ray);
        }
        benchmark::DoNotOptimize(packet);
    }
}

std::size_t rays_of(std::span<const TracedPacket> packets) {
    std::size_t rays = 0;
    for (const TracedPacket& packet : packets)
        rays += static_cast<std::size_t>(std::popcount(packet.valid));
    return rays;
}

}  // namespace reprise::bench

// What the linker puts in the place of Embree's two calls.
extern "C" {

void __real_rtcIntersect8(const int*, RTCScene, RTCIntersectContext*, RTCRayHit8*);
void __real_rtcOccluded8(const int*, RTCScene, RTCIntersectContext*, RTCRay8*);

void __wrap_rtcIntersect8(const int* valid,
                          RTCScene scene,
                          RTCIntersectContext* context,
                          RTCRayHit8* packet) {
    using namespace reprise::bench;
    if (noted_packets != nullptr)
        noted_packets->push_back(noted(valid, scene, *context, packet->ray, true));
    __real_rtcIntersect8(valid, scene, context, packet);
}

void __wrap_rtcOccluded8(const int* valid,
                         RTCScene scene,
                         RTCIntersectContext* context,
                         RTCRay8* packet) {
    using namespace reprise::bench;
    if (noted_packets != nullptr)
        noted_packets->push_back(noted(valid, scene, *context, *packet, false));
    __real_rtcOccluded8(valid, scene, context, packet);
}
}
