#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "remote/descriptor.h"

namespace reprise::remote {

/// Memory that several processes look at, without a name: it goes with the last of them. Its size
/// is sealed, so that none of them can pull it away from under another.
class SharedMemory {
  public:
    /// New memory, all zero. Throws world::Error when there is none.
    explicit SharedMemory(std::size_t bytes);

    enum class Use { look, write };

    /// What another process handed over. Throws world::Error when it is not so large, or not
    /// sealed.
    SharedMemory(Descriptor descriptor, std::size_t bytes, Use use);

    ~SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    std::span<const std::uint8_t> bytes() const { return {start_, size_}; }

    /// Only where it may be written.
    std::span<std::uint8_t> writable() { return {start_, size_}; }

    int descriptor() const { return descriptor_.number(); }

    /// For those who may look only.
    Descriptor for_looking() const;

  private:
    void map(Use use);

    Descriptor descriptor_;
    std::size_t size_;
    std::uint8_t* start_ = nullptr;
};

}  // namespace reprise::remote
