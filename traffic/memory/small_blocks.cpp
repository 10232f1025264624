// What it must do: operator new and delete of the whole program, its libraries included, as the
//   standard wants them; quick for small blocks, which lie close together.
// What it assumes: most of them are asked for and given back by one thread, the first one.
// How it goes: pieces of one range of addresses, each cut into blocks of one size; a block that is
//   given back is the next one of its size to be given out. What other threads ask for, large
//   blocks, and what is beyond the range come from malloc. What other threads give back is kept
//   aside until the first thread is out of blocks.
// What it keeps: the range until the program ends. Its pages are the system's until they are used.
//   A copy of the process (fork) by the first thread goes on with both; by another one, with
//   malloc.
#include "traffic/memory/small_blocks.h"

// Sanitizers have operators of their own, which find out what goes wrong.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define REPRISE_SMALL_BLOCKS
#endif

#ifdef REPRISE_SMALL_BLOCKS

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <sys/mman.h>

namespace reprise::traffic {

namespace {

constexpr std::size_t grain = __STDCPP_DEFAULT_NEW_ALIGNMENT__;  // [bytes] between two sizes
constexpr std::size_t largest = 64 * grain;                      // [bytes]
constexpr std::size_t piece_bytes = std::size_t{64} << 10;
constexpr std::size_t range_bytes = std::size_t{256} << 20;
constexpr std::size_t huge_page = std::size_t{2} << 20;

struct Block {
    Block* next;
};

/// Of one size: what was given back, and what was never given out yet.
struct Blocks {
    Block* free;
    std::byte* fresh;
    std::byte* end;

    void put(Block* block) {
        block->next = free;
        free = block;
    }

    void* take() {
        Block* block = free;
        free = block->next;
        return block;
    }
};

// All of this is there before any constructor runs: the first one may ask for a block.
constinit std::byte* range = nullptr;
constinit std::byte* next_piece = nullptr;
constinit bool has_owner = false;
constinit thread_local bool is_owner = false;
constinit std::array<Blocks, largest / grain + 1> sizes{};  // [i] of i grains; of 0 one as well
constinit std::array<std::uint8_t, range_bytes / piece_bytes> grains_in{};  // [i] of piece i
constinit std::atomic<Block*> from_others = nullptr;

std::size_t place_of(const void* block) {
    return static_cast<std::size_t>(reinterpret_cast<std::uintptr_t>(block) -
                                    reinterpret_cast<std::uintptr_t>(range));
}

bool is_in_range(const void* block) {
    return range != nullptr && place_of(block) < range_bytes;
}

Blocks& size_of(const Block* block) {
    return sizes[grains_in[place_of(block) / piece_bytes]];
}

/// Once, by the first thread, before there are others. Without a range all goes to malloc.
void reserve_range() {
    has_owner = true;
    void* mapped = mmap(nullptr,
                        range_bytes + huge_page,
                        PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
                        -1,
                        0);
    if (mapped == MAP_FAILED)
        return;
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(mapped) % huge_page;
    range = static_cast<std::byte*>(mapped) + (huge_page - beyond);
    next_piece = range;
    is_owner = true;
    madvise(range, range_bytes, MADV_HUGEPAGE);  // where there are none, small ones do
}

void take_from_others() {
    for (Block* block = from_others.exchange(nullptr, std::memory_order_acquire);
         block != nullptr;) {
        Block* const next = block->next;
        size_of(block).put(block);
        block = next;
    }
}

void* from_malloc(std::size_t bytes) {
    for (;;) {
        if (void* block = std::malloc(bytes > 0 ? bytes : 1))
            return block;
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr)
            throw std::bad_alloc();
        handler();
    }
}

[[gnu::noinline]] void* make(std::size_t bytes) {
    if (!has_owner)
        reserve_range();
    if (bytes > largest || !is_owner)
        return from_malloc(bytes);
    const std::size_t grains = (bytes + grain - 1) / grain;
    Blocks& blocks = sizes[grains];
    take_from_others();
    if (blocks.free != nullptr)
        return blocks.take();
    const std::size_t block_bytes = (grains > 0 ? grains : 1) * grain;
    if (static_cast<std::size_t>(blocks.end - blocks.fresh) < block_bytes) {
        if (next_piece == range + range_bytes)
            return from_malloc(bytes);
        blocks.fresh = next_piece;
        blocks.end = next_piece += piece_bytes;
        grains_in[place_of(blocks.fresh) / piece_bytes] = static_cast<std::uint8_t>(grains);
    }
    void* block = blocks.fresh;
    blocks.fresh += block_bytes;
    return block;
}

}  // namespace

bool is_small_block(const void* block) {
    return is_in_range(block);
}

}  // namespace reprise::traffic

void* operator new(std::size_t bytes) {
    using namespace reprise::traffic;
    if (bytes <= largest && is_owner) {
        Blocks& blocks = sizes[(bytes + grain - 1) / grain];
        if (blocks.free != nullptr)
            return blocks.take();
    }
    return make(bytes);
}

void operator delete(void* freed) noexcept {
    using namespace reprise::traffic;
    if (!is_in_range(freed))
        return std::free(freed);
    auto* block = static_cast<Block*>(freed);
    if (is_owner)
        return size_of(block).put(block);
    block->next = from_others.load(std::memory_order_relaxed);
    while (!from_others.compare_exchange_weak(
        block->next, block, std::memory_order_release, std::memory_order_relaxed)) {
    }
}

void operator delete(void* freed, std::size_t) noexcept {
    operator delete(freed);
}

#else

namespace reprise::traffic {

bool is_small_block(const void*) {
    return false;
}

}  // namespace reprise::traffic

#endif
