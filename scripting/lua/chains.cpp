#include "scripting/lua/chains.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace reprise::scripting {

namespace {

/// Where in an entry Lua 5.4 keeps how many entries on the next one of its chain is; 0: none.
constexpr std::size_t next_offset = 12;

/// Where in a short text Lua 5.4 keeps the next one of its chain.
constexpr std::size_t next_text_offset = 16;

std::size_t successor(const void* block, std::size_t entry) {
    std::int32_t step = 0;
    std::memcpy(
        &step, static_cast<const std::byte*>(block) + entry * key_slot + next_offset, sizeof step);
    // Wraps to something large when it points before the block.
    return entry + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(step));
}

}  // namespace

std::size_t longest_chain(const void* block, std::size_t entries) {
    std::vector<bool> follows(entries, false);
    for (std::size_t entry = 0; entry < entries; ++entry) {
        const std::size_t next = successor(block, entry);
        if (next >= entries)
            return 1;  // a block of the same size that holds something else
        if (next != entry)
            follows[next] = true;
    }
    std::size_t longest = 1;
    std::size_t steps = 0;
    for (std::size_t first = 0; first < entries && steps <= entries; ++first) {
        if (follows[first])
            continue;
        std::size_t length = 1;
        std::size_t entry = first;
        for (std::size_t next = successor(block, entry); next != entry && ++steps <= entries;
             next = successor(block, entry)) {
            entry = next;
            ++length;
        }
        longest = std::max(longest, length);
    }
    return longest;
}

std::size_t longest_chain(const TextTable& texts) {
    std::size_t longest = 0;
    for (int chain = 0; chain < texts.size; ++chain) {
        std::size_t length = 0;
        for (const void* text = texts.chains[chain]; text != nullptr; ++length)
            std::memcpy(&text, static_cast<const std::byte*>(text) + next_text_offset, sizeof text);
        longest = std::max(longest, length);
    }
    return longest;
}

}  // namespace reprise::scripting
