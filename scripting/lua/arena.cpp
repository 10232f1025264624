#include "scripting/lua/arena.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <new>
#include <sys/mman.h>

#include <boost/interprocess/mem_algo/rbtree_best_fit.hpp>
#include <boost/interprocess/sync/mutex_family.hpp>

namespace reprise::scripting {

namespace {

constexpr std::size_t reserved = std::size_t{512} << 20U;  // [bytes] of address space
constexpr std::uintptr_t alignment = std::uintptr_t{1} << 32U;
// From 32 TiB on: above AddressSanitizer's shadow, below the libraries and the stack.
constexpr std::uintptr_t first_place = std::uintptr_t{0x2000} << 32U;
constexpr std::uintptr_t places = 0x4000;

constexpr std::size_t grain = 16;                    // [bytes]
constexpr std::size_t largest_small = 512;           // [bytes] from free lists, never joined again
constexpr std::size_t slab = std::size_t{8} << 10U;  // [bytes] cut into small blocks at a time

using BestFit = boost::interprocess::rbtree_best_fit<boost::interprocess::null_mutex_family>;

void* reserve() {
    for (std::uintptr_t place = 0; place < places; ++place) {
        // An address, as mmap's hint; another one comes back where something lies already.
        // NOLINTNEXTLINE(performance-no-int-to-ptr)
        void* const wanted = reinterpret_cast<void*>(first_place + place * alignment);
        void* const got = mmap(wanted,
                               reserved,
                               PROT_READ | PROT_WRITE,
                               MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
                               -1,
                               0);
        if (got == wanted)
            return got;
        if (got == MAP_FAILED)
            throw std::bad_alloc();
        munmap(got, reserved);
    }
    throw std::bad_alloc();
}

std::size_t rounded(std::size_t size) {
    return (size + grain - 1) / grain * grain;
}

}  // namespace

struct Arena::Heap {
    struct Free {
        Free* next;
    };

    explicit Heap(void* base) : rest(::new (base) BestFit(reserved, 0)) {}

    BestFit* rest;
    std::array<Free*, largest_small / grain + 1> small{};  ///< by size in grains

    void* take_small(std::size_t size) {
        Free*& list = small[size / grain];
        if (list == nullptr) {
            auto* const piece = static_cast<std::byte*>(rest->allocate(slab));
            if (piece == nullptr)
                return nullptr;
            // Pushed from the end, so that they are taken in the order of their addresses.
            for (std::size_t count = slab / size; count-- > 0;)
                list = ::new (piece + count * size) Free{list};
        }
        Free* const taken = list;
        list = taken->next;
        return taken;
    }
};

Arena::Arena() : base_(reserve()), heap_(std::make_unique<Heap>(base_)) {}

Arena::~Arena() {
    munmap(base_, reserved);
}

void* Arena::allocate(std::size_t size) {
    return size <= largest_small ? heap_->take_small(rounded(size)) : heap_->rest->allocate(size);
}

void Arena::release(void* block, std::size_t size) {
    if (size > largest_small) {
        heap_->rest->deallocate(block);
        return;
    }
    Heap::Free*& list = heap_->small[rounded(size) / grain];
    list = ::new (block) Heap::Free{list};
}

void* Arena::resize(void* block, std::size_t old_size, std::size_t new_size) {
    if (block == nullptr)
        return allocate(new_size);
    const bool stays = std::max(old_size, new_size) <= largest_small
                           ? rounded(old_size) == rounded(new_size)
                           : old_size == new_size;
    if (stays)
        return block;
    void* const moved = allocate(new_size);
    if (moved == nullptr)
        return nullptr;
    std::memcpy(moved, block, std::min(old_size, new_size));
    release(block, old_size);
    return moved;
}

}  // namespace reprise::scripting
