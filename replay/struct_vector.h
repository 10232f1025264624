#pragma once

#include <cstdint>

#include <flatbuffers/flatbuffers.h>

#include "replay/mcap/mcap.h"

/// Private to the room: what FlatBuffers' own verifier leaves unchecked.
namespace reprise::replay {

/// Nothing of ours nests deeper than four tables; a large town has some 10,000 of them.
inline flatbuffers::Verifier verifier(mcap::View bytes) {
    return {bytes.data(), bytes.size(), 8, 1'000'000};
}

/// Whether a vector of structs is there and its elements are aligned: the verifier checks only the
/// alignment of its length. (Empty ones lie anywhere: the builder aligns only what it writes.)
template <typename T>
bool is_aligned(const flatbuffers::Vector<const T*>* vector) {
    return vector != nullptr &&
           (vector->size() == 0 ||
            reinterpret_cast<std::uintptr_t>(vector->Data()) % alignof(T) == 0);
}

}  // namespace reprise::replay
