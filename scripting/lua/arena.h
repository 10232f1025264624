#pragma once

#include <cstddef>
#include <memory>

namespace reprise::scripting {

/// The memory that a Lua machine lives in.
///
/// What must it do?   Give equal addresses for equal requests: Lua hashes objects by the lower half
///                    of their address, and the hash decides when a table grows and so when memory
///                    is collected.
/// How?               One reservation at a multiple of 4 GiB, so that the lower half is the same in
///                    every process; small blocks from free lists, others by Boost's best fit.
/// What does it cost? Address space. Pages are taken when first touched.
class Arena {
  public:
    /// Throws std::bad_alloc when the system has no address range left.
    Arena();
    ~Arena();
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// As realloc, with the old size known; both sizes above 0 but for a null block's. Null when
    /// there is no room; then the old block is as it was.
    void* resize(void* block, std::size_t old_size, std::size_t new_size);

    void release(void* block, std::size_t size);

  private:
    struct Heap;

    void* allocate(std::size_t size);

    void* base_ = nullptr;
    std::unique_ptr<Heap> heap_;
};

}  // namespace reprise::scripting
