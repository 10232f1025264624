#include "replay/table/value_text.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace reprise::replay {

namespace {

template <typename Real>
std::string shortest(Real value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
    return {text, end};
}

/// Bits as a number that grows with the value, across zero too.
template <typename Bits, typename Real>
Bits ordered(Real value) {
    constexpr Bits sign = Bits{1} << (8 * sizeof(Bits) - 1);
    const auto bits = std::bit_cast<Bits>(value);
    return (bits & sign) != 0 ? sign - (bits & ~sign) : sign + bits;
}

template <typename Bits, typename Real>
std::string distance(Real expected, Real found) {
    constexpr Bits worth_saying = 1'000'000;
    if (!std::isfinite(expected) || !std::isfinite(found))
        return "";
    const auto low = std::min(ordered<Bits>(expected), ordered<Bits>(found));
    const auto high = std::max(ordered<Bits>(expected), ordered<Bits>(found));
    const Bits units = high - low;
    if (units == 0)
        return "they differ in the sign of zero";
    if (units > worth_saying)
        return "";
    return fmt::format("{} unit{} in the last place apart", units, units == 1 ? "" : "s");
}

/// The line of `text` that holds this position, quoted and cut to a readable length around it.
std::string line_at(std::string_view text, std::size_t position) {
    constexpr std::size_t widest = 100;
    position = std::min(position, text.size());
    const std::size_t before =
        position == 0 ? std::string_view::npos : text.rfind('\n', position - 1);
    const std::size_t from = before == std::string_view::npos ? 0 : before + 1;
    std::size_t to = std::min(text.find('\n', position), text.size());
    std::size_t start = from;
    if (position - from > widest / 2)
        start = position - widest / 2;
    to = std::min(to, start + widest);
    return fmt::format("'{}'", text.substr(start, to - start));
}

}  // namespace

std::string decimal(double value) {
    return shortest(value);
}

std::string decimal(float value) {
    return shortest(value);
}

std::string value_text(double value) {
    return fmt::format("{} (0x{:016x})", decimal(value), std::bit_cast<std::uint64_t>(value));
}

std::string value_text(float value) {
    return fmt::format("{} (0x{:08x})", decimal(value), std::bit_cast<std::uint32_t>(value));
}

std::string distance_text(double expected, double found) {
    return distance<std::uint64_t>(expected, found);
}

std::string distance_text(float expected, float found) {
    return distance<std::uint32_t>(expected, found);
}

std::pair<std::string, std::string> text_pair(std::string_view expected, std::string_view found) {
    const std::size_t common = static_cast<std::size_t>(
        std::mismatch(expected.begin(), expected.end(), found.begin(), found.end()).first -
        expected.begin());
    std::string line;
    if (expected.find('\n') != std::string_view::npos || found.find('\n') != std::string_view::npos)
        line = fmt::format("line {}: ",
                           1 + std::count(expected.begin(),
                                          expected.begin() + static_cast<std::ptrdiff_t>(common),
                                          '\n'));
    return {line + line_at(expected, common), line + line_at(found, common)};
}

}  // namespace reprise::replay
