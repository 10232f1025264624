#pragma once

#include <memory>

namespace reprise::walkers {

/// Calls the C function that gives back what Recast or Detour allocated.
template <typename T, void (*release)(T*)>
struct Release {
    void operator()(T* thing) const { release(thing); }
};

/// Something that Recast or Detour allocated.
template <typename T, void (*release)(T*)>
using Owned = std::unique_ptr<T, Release<T, release>>;

}  // namespace reprise::walkers
