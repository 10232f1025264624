#include "replay/table/value.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "world/printable.h"

namespace reprise::replay {

namespace {

using Json = nlohmann::ordered_json;  // as trace_parts.cpp: one kind of JSON is compiled

template <typename Number>
void append_number(Number value, std::string& out) {
    char text[64];
    out.append(text, std::to_chars(text, text + sizeof(text), value).ptr);
}

/// Fewest digits that read back the same; "nan" and such as Python, JavaScript and SQLite know
/// them.
template <typename Real>
bool append_special(Real value, std::string& out) {
    if (std::isfinite(value))
        return false;
    out += std::isnan(value) ? "NaN" : value > 0 ? "Infinity" : "-Infinity";
    return true;
}

template <typename Real>
void append_real_json(Real value, std::string& out) {
    std::string special;
    if (append_special(value, special))
        out += "\"" + special + "\"";
    else
        append_number(value, out);
}

void append_csv_text(const std::string& said, std::string& out) {
    const std::string text = world::printable_lines(said);
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char c : text)
        out.append(c == '"' ? 2 : 1, c);
    out += '"';
}

template <typename... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};

template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace

void append_json(std::string_view text, std::string& out) {
    const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
        return c >= ' ' && c < 0x7f && c != '"' && c != '\\';
    });
    if (plain)
        out.append("\"").append(text).append("\"");
    else
        out += Json(text).dump(
            -1, ' ', world::printable(text) != text, Json::error_handler_t::replace);
}

std::string valid_utf8(std::string_view text) {
    std::string json;
    append_json(text, json);
    return Json::parse(json).get<std::string>();
}

void append_json(const Value& value, std::string& out) {
    std::visit(Overloaded{[&](std::monostate) { out += "null"; },
                          [&](bool v) { out += v ? "true" : "false"; },
                          [&](std::int64_t v) { append_number(v, out); },
                          [&](std::uint64_t v) {
                              out += '"';
                              append_number(v, out);
                              out += '"';
                          },
                          [&](float v) { append_real_json(v, out); },
                          [&](double v) { append_real_json(v, out); },
                          [&](const std::string& v) { append_json(std::string_view(v), out); }},
               value);
}

void append_csv(const Value& value, std::string& out) {
    const auto real = [&](auto v) {
        if (!append_special(v, out))
            append_number(v, out);
    };
    std::visit(Overloaded{[](std::monostate) {},
                          [&](bool v) { out += v ? "true" : "false"; },
                          [&](std::int64_t v) { append_number(v, out); },
                          [&](std::uint64_t v) { append_number(v, out); },
                          [&](float v) { real(v); },
                          [&](double v) { real(v); },
                          [&](const std::string& v) { append_csv_text(v, out); }},
               value);
}

}  // namespace reprise::replay
