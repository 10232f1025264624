#pragma once

#include <cstddef>

namespace reprise::scripting {

/// [bytes] of an entry in the key part of a table of Lua 5.4.
inline constexpr std::size_t key_slot = 24;

/// The most entries that a look-up may have to pass in a table's key part of so many entries: keys
/// with equal hashes form a chain. 1 when the block is no such part. O(entries), about 2 ns each.
std::size_t longest_chain(const void* block, std::size_t entries);

/// Where a machine of Lua 5.4 keeps all its short texts, each once: chains by hash.
struct TextTable {
    const void* const* chains;
    int count;  ///< of texts
    int size;   ///< of chains, a power of two
};

/// The most texts that Lua may have to pass to find one. O(texts and chains), about 5 ns each.
std::size_t longest_chain(const TextTable& texts);

}  // namespace reprise::scripting
