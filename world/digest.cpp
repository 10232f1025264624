#include "world/digest.h"

#include <array>
#include <cstdio>
#include <cstring>

#include <xxhash.h>

namespace reprise::world {

struct Hasher::State {
    XXH3_state_t* stream = XXH3_createState();
    // Most of what comes is a number: many of them at once cost a tenth.
    std::array<unsigned char, 1024> gathered;  // valid up to size
    std::size_t size = 0;

    void flush() {
        XXH3_128bits_update(stream, gathered.data(), size);
        size = 0;
    }
};

Hasher::Hasher() : state_(std::make_unique_for_overwrite<State>()) {
    XXH3_128bits_reset(state_->stream);
}

Hasher::~Hasher() {
    XXH3_freeState(state_->stream);
}

void Hasher::add_text(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    add_bytes(text.data(), text.size());
}

void Hasher::add_bytes(const void* bytes, std::size_t size) {
    State& state = *state_;
    if (size > state.gathered.size() - state.size)
        state.flush();
    if (size > state.gathered.size()) {
        XXH3_128bits_update(state.stream, bytes, size);
        return;
    }
    unsigned char* end = state.gathered.data() + state.size;
    if (size == sizeof(std::uint64_t))  // by far the most; one instruction
        std::memcpy(end, bytes, sizeof(std::uint64_t));
    else if (size > 0)
        std::memcpy(end, bytes, size);
    state.size += size;
}

std::uint64_t Hasher::digest64() const {
    // The 128-bit stream's low half: one stream serves both widths.
    state_->flush();
    return XXH3_128bits_digest(state_->stream).low64;
}

Digest128 Hasher::digest128() const {
    state_->flush();
    const XXH128_hash_t hash = XXH3_128bits_digest(state_->stream);
    return {hash.low64, hash.high64};
}

std::uint64_t digest64(std::uint64_t before, const void* bytes, std::size_t size) {
    return XXH3_64bits_withSeed(bytes, size, before);
}

Digest128 digest128(std::string_view bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return {hash.low64, hash.high64};
}

std::string to_hex(const Digest128& digest) {
    std::array<char, 33> text{};
    std::snprintf(text.data(),
                  text.size(),
                  "%016llx%016llx",
                  static_cast<unsigned long long>(digest.high()),
                  static_cast<unsigned long long>(digest.low()));
    return text.data();
}

Digest128 chain(const Digest128& previous, const Digest128& state) {
    const std::array<Digest128, 2> link{previous, state};
    const XXH128_hash_t hash = XXH3_128bits(link.data(), sizeof(link));
    return {hash.low64, hash.high64};
}

}  // namespace reprise::world
