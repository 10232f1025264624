#pragma once

#include <cstdint>
#include <string_view>

namespace reprise::scripting {

/// Of Lua's hash of texts, in every machine: set by Vm, in the place of one from the clock.
inline constexpr std::uint32_t hash_seed = 0x5EEDU;

/// As Lua 5.4 hashes a text with that seed.
inline std::uint32_t text_hash(std::string_view text) {
    std::uint32_t hash = hash_seed ^ static_cast<std::uint32_t>(text.size());
    for (std::size_t i = text.size(); i-- > 0;)
        hash ^= (hash << 5U) + (hash >> 2U) + static_cast<unsigned char>(text[i]);
    return hash;
}

}  // namespace reprise::scripting
