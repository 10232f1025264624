#pragma once

#include <functional>
#include <mutex>
#include <utility>

#include "render/trace/instance.h"

namespace reprise::render {

/// A prototype that is made when somebody first asks for it, from any thread: people are of fifty
/// kinds, each with a mesh and a tree of half a millisecond, and a tick shows few of them.
class LatePrototype {
  public:
    explicit LatePrototype(std::function<Prototype()> make) : make_(std::move(make)) {}

    const Prototype* get() const {
        std::call_once(asked_, [this] { prototype_ = make_(); });
        return &prototype_;
    }

  private:
    std::function<Prototype()> make_;
    mutable std::once_flag asked_;
    mutable Prototype prototype_;
};

}  // namespace reprise::render
