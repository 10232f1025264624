#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace reprise::replay {

/// One number or text of a tick. Reals keep their width: it decides how many digits they need.
/// Enumerators are their names; monostate: the tick has none.
using Value =
    std::variant<std::monostate, bool, std::int64_t, std::uint64_t, float, double, std::string>;

/// As JSON: reals in the fewest digits that read back the same, 64-bit whole numbers in quotes
/// (readers keep 53 bits), what is no number as "NaN", "Infinity", "-Infinity"; absent: null.
void append_json(const Value& value, std::string& out);

/// A text in quotes; what is not UTF-8 in it is replaced.
void append_json(std::string_view text, std::string& out);

/// The text with what is not UTF-8 in it replaced by U+FFFD.
std::string valid_utf8(std::string_view text);

/// As a cell of a CSV file (RFC 4180): digits as above, no quotes around numbers; absent: empty.
void append_csv(const Value& value, std::string& out);

}  // namespace reprise::replay
