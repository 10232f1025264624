#include "scripting/lua/memory.h"

#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <lua.hpp>

#include "world/random.h"

namespace reprise::scripting {

namespace {

std::uintptr_t lower_half(const void* block) {
    return reinterpret_cast<std::uintptr_t>(block) & 0xffffffffU;
}

/// Takes and gives back blocks of many sizes; what lay where.
std::vector<std::uintptr_t> exercise(Arena& arena) {
    struct Block {
        unsigned char* place;
        std::size_t size;
    };

    std::vector<Block> blocks;
    std::vector<std::uintptr_t> places;
    for (std::uint64_t step = 0; step < 3000; ++step) {
        const double chance = world::draw(1, step, world::Purpose::scenario, 0);
        const auto size = static_cast<std::size_t>(1 + 3000 * chance * chance * chance *
                                                           (step % 50 == 0 ? 100 : 1));
        if (step % 3 == 2 && !blocks.empty()) {
            const std::size_t which = step * 7919 % blocks.size();
            Block& block = blocks[which];
            for (std::size_t i = 0; i < block.size; ++i)
                EXPECT_EQ(block.place[i], static_cast<unsigned char>(block.size));
            if (step % 2 == 0) {
                arena.release(block.place, block.size);
                blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(which));
                continue;
            }
            block.place = static_cast<unsigned char*>(arena.resize(block.place, block.size, size));
            block.size = size;
        } else {
            blocks.push_back({static_cast<unsigned char*>(arena.resize(nullptr, 0, size)), size});
        }
        Block& block = step % 3 == 2 ? blocks[step * 7919 % blocks.size()] : blocks.back();
        std::memset(block.place, static_cast<int>(block.size & 0xff), block.size);
        places.push_back(lower_half(block.place));
        EXPECT_EQ(lower_half(block.place) % 16, 0U);
    }
    return places;
}

}  // namespace

TEST(Arena, GivesEqualAddressesInTheirLowerHalvesToEqualRequests) {
    Arena one;
    Arena two;  // while the first is alive
    EXPECT_EQ(exercise(one), exercise(two));
}

TEST(Arena, RefusesWhatItDoesNotHoldAndGoesOn) {
    Arena arena;
    EXPECT_EQ(arena.resize(nullptr, 0, std::size_t{1} << 30U), nullptr);
    void* const block = arena.resize(nullptr, 0, 1000);
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(arena.resize(block, 1000, std::size_t{1} << 30U), nullptr);
    arena.release(block, 1000);
}

TEST(Memory, ALongTextMakesInstructionsDearerWhileItLives) {
    Account account;
    Memory memory(account);
    EXPECT_EQ(memory.rate(), 1U);
    void* const text = memory.resize(nullptr, 0, LUA_TSTRING, 60'000);
    EXPECT_GE(account.all, 60'000U / 8);
    EXPECT_GT(memory.rate(), 50U);
    memory.resize(text, 60'000, LUA_TNIL, 0);
    EXPECT_EQ(memory.rate(), 1U);
    EXPECT_EQ(memory.bytes(), 0U);
}

TEST(Memory, FollowsAStackThatGrows) {
    constexpr std::size_t small = 45 * 16;
    constexpr std::size_t large = 5000 * 16;
    Account account;
    Memory memory(account);
    memory.resize(nullptr, 0, LUA_TTHREAD, 200);
    void* const stack = memory.resize(nullptr, 0, LUA_TNIL, small);
    std::memset(stack, 7, small);
    void* const grown = memory.resize(nullptr, 0, LUA_TNIL, large);
    std::memcpy(grown, stack, small);
    EXPECT_EQ(memory.rate(), 1U);
    memory.resize(stack, small, LUA_TNIL, 0);
    EXPECT_GT(memory.rate(), 5U);
    memory.resize(grown, large, LUA_TNIL, 0);
    EXPECT_EQ(memory.rate(), 1U);
}

}  // namespace reprise::scripting
