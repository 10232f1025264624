#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <embree3/rtcore.h>

namespace reprise::bench {

/// A packet of rays as Embree was given it, and what for. 272 bytes.
struct TracedPacket {
    using Lanes = std::array<float, 8>;

    std::array<Lanes, 3> origin;
    std::array<Lanes, 3> direction;
    Lanes far;
    std::array<std::uint32_t, 8> mask;
    RTCScene scene;
    unsigned char valid;  ///< bit i: lane i
    bool nearest;         ///< the nearest hit, else only whether there is one
    bool coherent;
};

/// Every packet that this program gives to Embree while `work` runs, from one thread. Linked with
/// --wrap of the two calls, so that what is measured is the tracer as it ships.
template <typename Work>
std::vector<TracedPacket> traced_packets(const Work& work);

/// Gives the packets to Embree again, in their order, with nothing in between. The scenes must be
/// what they were. Reading the packets from memory is part of it, at most a tenth of the time.
void trace_again(std::span<const TracedPacket> packets);

/// In both kinds.
std::size_t rays_of(std::span<const TracedPacket> packets);

/// Where packets are noted; none: nowhere.
extern std::vector<TracedPacket>* noted_packets;

template <typename Work>
std::vector<TracedPacket> traced_packets(const Work& work) {
    std::vector<TracedPacket> packets;
    noted_packets = &packets;
    work();
    noted_packets = nullptr;
    return packets;
}

}  // namespace reprise::bench
