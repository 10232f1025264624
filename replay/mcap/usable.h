#pragma once

#include <cstdint>

#include <flatbuffers/flatbuffers.h>

#include "replay/mcap/mcap.h"

namespace reprise::replay {

/// Nothing of ours nests deeper than four tables; a large town has some 10,000 of them.
inline flatbuffers::Verifier verifier(mcap::View bytes) {
    return {bytes.data(), bytes.size(), 8, 1'000'000};
}

/// Present, and aligned: the verifier checks only a struct vector's length field for alignment.
/// (Empty ones lie anywhere: the builder aligns only what it writes.)
template <typename T>
bool usable(const flatbuffers::Vector<const T*>* vector) {
    return vector != nullptr &&
           (vector->size() == 0 ||
            reinterpret_cast<std::uintptr_t>(vector->Data()) % alignof(T) == 0);
}

template <typename T>
bool usable_or_absent(const flatbuffers::Vector<const T*>* vector) {
    return vector == nullptr || usable(vector);
}

}  // namespace reprise::replay
