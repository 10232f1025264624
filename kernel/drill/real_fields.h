#pragma once

// Private to the room: the numbers in the record's structs, through FlatBuffers' type tables.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <flatbuffers/minireflect.h>
#include <fmt/format.h>

#include "world/check.h"

namespace reprise::kernel {

/// A real number in a struct of the record.
struct RealField {
    std::string path;  ///< such as velocity.x
    std::size_t offset = 0;
    bool is_double = false;
};

/// All real numbers in a struct, so that a field added to a schema can be nudged without a line
/// here.
std::vector<RealField> real_fields(const flatbuffers::TypeTable& type, const std::string& prefix);

std::string wheel_prefix(unsigned index);

/// Every field that can be asked for.
std::vector<std::string> known_fields();

template <typename Integer>
std::optional<Integer> whole(std::string_view text) {
    Integer value{};
    if (text.starts_with('+'))
        text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

/// Numbers of one type in their order, both zeros at 0.
template <typename Bits, typename Real>
Real moved(Real value, std::int64_t units) {
    const auto flip = [](Bits bits) {
        return bits >= 0 ? bits : static_cast<Bits>(std::numeric_limits<Bits>::min() - bits);
    };
    const std::int64_t place = flip(std::bit_cast<Bits>(value)) + units;
    const Bits last = std::bit_cast<Bits>(std::numeric_limits<Real>::max());
    if (!std::isfinite(value) || place > last || place < -std::int64_t{last})
        throw world::Error(
            fmt::format("--nudge: {} units from {} there is no number", units, value));
    return std::bit_cast<Real>(flip(static_cast<Bits>(place)));
}

/// The default goes towards zero from above, so that a full lock stays one.
template <typename Real>
std::int64_t units_for(Real value, std::int64_t wanted) {
    return wanted != 0 ? wanted : value > 0 ? -1 : 1;
}

}  // namespace reprise::kernel
