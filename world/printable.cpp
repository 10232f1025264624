#include "world/printable.h"

#include <cstddef>

namespace reprise::world {

namespace {

/// One character of UTF-8 at the start of a text.
struct Character {
    std::size_t size = 0;  ///< [bytes]; 0: none is there
    char32_t code = 0;
};

Character first_of(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const unsigned lead = byte(0);
    if (lead < 0x80)
        return {1, static_cast<char32_t>(lead)};
    const std::size_t size = lead >= 0xc2 && lead < 0xe0   ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
    if (size == 0)
        return {};
    char32_t code = lead & (0x7fU >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xc0U) != 0x80U)
            return {};
        code = (code << 6U) | (byte(i) & 0x3fU);
    }
    const bool overlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return overlong || surrogate || code > 0x10ffff ? Character{} : Character{size, code};
}

bool is_shown(char32_t code) {
    if (code < 0xa0)
        return (code >= 0x20 && code < 0x7f) || code == '\t';
    const bool turns_direction = code == 0x61c || code == 0x200e || code == 0x200f ||
                                 (code >= 0x2028 && code <= 0x202e) ||
                                 (code >= 0x2066 && code <= 0x2069);
    return !turns_direction;
}

std::string shown(std::string_view text, bool with_lines) {
    constexpr const char* digits = "0123456789abcdef";
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Character character = first_of(text);
        const std::size_t size = character.size == 0 ? 1 : character.size;
        const bool stays = character.size != 0 &&
                           (is_shown(character.code) || (with_lines && character.code == '\n'));
        for (const char c : text.substr(0, size)) {
            const auto byte = static_cast<unsigned char>(c);
            if (stays)
                out += c;
            else
                out += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
        }
        text.remove_prefix(size);
    }
    return out;
}

}  // namespace

std::string printable(std::string_view text) {
    return shown(text, false);
}

std::string printable_lines(std::string_view text) {
    return shown(text, true);
}

}  // namespace reprise::world
