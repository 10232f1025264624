#pragma once

#include <cstdint>

namespace reprise::world {

/// Mixes bits (Wellons' lowbias32): for what is drawn from a thing's style or place alone.
constexpr std::uint32_t hash(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

constexpr std::uint32_t hash(std::uint32_t x, std::uint32_t y) {
    return hash(x * 0x9e3779b1u + hash(y));
}

constexpr std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return hash(hash(x, y), z);
}

/// Hashed bits as a number in [0, 1).
constexpr float unit(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1.0p-24F;
}

}  // namespace reprise::world
