#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "world/common_generated.h"

namespace reprise::world {

/// Gathers state, field by field, and condenses it to XXH3 (output frozen since xxHash 0.8.0).
/// Values are fed as their little-endian bytes; -0.0 and +0.0 differ; feed no pointers and no
/// structs with padding. About 9 GB/s; gather arrays of structs at once where speed matters.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    /// Numbers, enumerators, and the padding-free structs of world/*.fbs.
    template <typename T>
    requires std::is_trivially_copyable_v<T>

    void add(const T& value) { add_bytes(&value, sizeof(T)); }

    template <typename T>
    requires std::is_trivially_copyable_v<T>

    void add(std::span<const T> values) {
        add(static_cast<std::uint64_t>(values.size()));
        add_bytes(values.data(), values.size_bytes());
    }

    /// Length and bytes, so that ("ab", "c") and ("a", "bc") differ.
    void add_text(std::string_view text);

    void add_bytes(const void* bytes, std::size_t size);

    std::uint64_t digest64() const;
    Digest128 digest128() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A running digest of things that come one by one: XXH3-64 of the bytes, seeded with the digest
/// of what came before. Equal digests mean equal histories. 10 ns.
std::uint64_t digest64(std::uint64_t before, const void* bytes, std::size_t size);

/// XXH3-128 of one run of bytes.
Digest128 digest128(std::string_view bytes);

/// 32 hexadecimal digits, high half first.
std::string to_hex(const Digest128& digest);

/// chain(t) = XXH3-128(chain(t-1), state(t)): equal chains mean equal histories, so the first
/// difference of two runs can be found by binary search.
Digest128 chain(const Digest128& previous, const Digest128& state);

}  // namespace reprise::world
