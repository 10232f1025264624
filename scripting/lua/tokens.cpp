#include "scripting/lua/tokens.h"

#include <algorithm>
#include <string>

namespace reprise::scripting {

namespace {

constexpr std::size_t none = std::string_view::npos;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

}  // namespace

/// The token between two places, and on behind it.
Token Tokens::cut(Token::Kind kind, std::size_t start, std::size_t end, std::size_t behind) {
    const Token token{kind, source_.substr(start, end - start), line_};
    const auto first = source_.begin() + static_cast<std::ptrdiff_t>(place_);
    const auto last = source_.begin() + static_cast<std::ptrdiff_t>(behind);
    line_ += static_cast<std::uint32_t>(std::count(first, last, '\n'));
    place_ = behind;
    return token;
}

/// At "[[" or "[==[": how many '='.
std::size_t Tokens::long_bracket() const {
    std::size_t end = place_ + 1;
    while (at(end) == '=')
        ++end;
    return at(place_) == '[' && at(end) == '[' ? end - place_ - 1 : none;
}

Token Tokens::long_text(std::size_t level) {
    const std::size_t start = place_ + level + 2;
    const std::string closing = "]" + std::string(level, '=') + "]";
    const std::size_t end = source_.find(closing, start);
    if (end == none)
        return cut(Token::Kind::end, place_, place_, source_.size());
    return cut(Token::Kind::text, start, end, end + closing.size());
}

bool Tokens::skip_comment() {
    if (at(place_) != '-' || at(place_ + 1) != '-')
        return false;
    place_ += 2;
    if (const std::size_t level = long_bracket(); level != none)
        long_text(level);
    else
        place_ = std::min(source_.find('\n', place_), source_.size());
    return true;
}

void Tokens::skip_blanks() {
    do {
        for (; place_ < source_.size(); ++place_) {
            const char c = source_[place_];
            if (c != ' ' && (c < '\t' || c > '\r'))
                break;
            line_ += c == '\n' ? 1 : 0;
        }
    } while (skip_comment());
}

Token Tokens::text(char quote) {
    std::size_t end = place_ + 1;
    while (end < source_.size() && source_[end] != quote) {
        const bool skips_blanks = source_[end] == '\\' && at(end + 1) == 'z';
        end += source_[end] == '\\' ? 2 : 1;
        while (skips_blanks && (at(end) == ' ' || (at(end) >= '\t' && at(end) <= '\r')))
            ++end;
    }
    if (end >= source_.size())
        return cut(Token::Kind::end, place_, place_, source_.size());
    return cut(Token::Kind::text, place_ + 1, end, end + 1);
}

Token Tokens::number() {
    const bool hexadecimal = at(place_) == '0' && (at(place_ + 1) | ' ') == 'x';
    std::size_t end = place_;
    for (;; ++end) {
        const char c = at(end);
        const bool exponent = (c | ' ') == (hexadecimal ? 'p' : 'e');
        if (exponent && (at(end + 1) == '+' || at(end + 1) == '-'))
            ++end;
        else if (c != '.' && !is_digit(c) && !is_letter(c))
            break;
    }
    return cut(Token::Kind::number, place_, end, end);
}

/// Only dots and colons join: no other symbol counts.
Token Tokens::symbol() {
    const char c = at(place_);
    std::size_t end = place_ + 1;
    while ((c == '.' && at(end) == c && end < place_ + 3) ||
           (c == ':' && at(end) == c && end < place_ + 2))
        ++end;
    return cut(Token::Kind::symbol, place_, end, end);
}

Token Tokens::next() {
    skip_blanks();
    const char c = at(place_);
    if (place_ >= source_.size())
        return {Token::Kind::end, {}, line_};
    if (c == '"' || c == '\'')
        return text(c);
    if (const std::size_t level = long_bracket(); level != none)
        return long_text(level);
    if (is_digit(c) || (c == '.' && is_digit(at(place_ + 1))))
        return number();
    if (!is_letter(c))
        return symbol();
    std::size_t end = place_;
    while (is_letter(at(end)) || is_digit(at(end)))
        ++end;
    return cut(Token::Kind::name, place_, end, end);
}

}  // namespace reprise::scripting
