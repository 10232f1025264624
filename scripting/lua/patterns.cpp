#include "scripting/lua/patterns.h"

#include <cctype>

#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr std::uint64_t steps_at_a_time = 1000;
constexpr std::size_t bytes_a_step = 16;  // of a set, which is read once for every character

[[noreturn]] void malformed(const char* what) {
    throw world::Error(std::string("malformed pattern: ") + what);
}

bool is_between(unsigned char c, char low, char high) {
    return c >= static_cast<unsigned char>(low) && c <= static_cast<unsigned char>(high);
}

/// %a, %d, ... of ASCII. Capital letters are the opposite; other characters stand for themselves.
bool in_class(unsigned char c, unsigned char letter) {
    const bool capital = is_between(letter, 'A', 'Z');
    const bool alpha = is_between(c, 'a', 'z') || is_between(c, 'A', 'Z');
    const bool digit = is_between(c, '0', '9');
    const bool graph = is_between(c, '!', '~');
    bool is = false;
    switch (capital ? letter - 'A' + 'a' : letter) {
        case 'a':
            is = alpha;
            break;
        case 'c':
            is = c < 32 || c == 127;
            break;
        case 'd':
            is = digit;
            break;
        case 'g':
            is = graph;
            break;
        case 'l':
            is = is_between(c, 'a', 'z');
            break;
        case 'p':
            is = graph && !alpha && !digit;
            break;
        case 's':
            is = c == ' ' || is_between(c, '\t', '\r');
            break;
        case 'u':
            is = is_between(c, 'A', 'Z');
            break;
        case 'w':
            is = alpha || digit;
            break;
        case 'x':
            is = digit || is_between(c, 'a', 'f') || is_between(c, 'A', 'F');
            break;
        default:
            return letter == c;
    }
    return is != capital;
}

}  // namespace

Pattern::Pattern(std::string_view text,
                 std::string_view pattern,
                 std::function<void(std::uint64_t)> pay)
    : text_(text),
      pattern_(pattern),
      pay_(std::move(pay)),
      anchored_(!pattern.empty() && pattern.front() == '^') {
    if (anchored_)
        pattern_.remove_prefix(1);
}

std::optional<std::size_t> Pattern::match_at(std::size_t start) {
    level_ = 0;
    depth_ = 0;
    return match(start, 0);
}

void Pattern::settle() {
    pay_(steps_);
    steps_ = 0;
}

void Pattern::step() {
    if (++steps_ >= steps_at_a_time)
        settle();
}

/// A set may be as long as the pattern, and is looked for its end and for the character.
void Pattern::pay_for_class(std::size_t p, std::size_t after) {
    steps_ += (after - p) / bytes_a_step;
}

/// 0 behind the end.
unsigned char Pattern::at(std::size_t p) const {
    return p < pattern_.size() ? static_cast<unsigned char>(pattern_[p]) : 0;
}

std::size_t Pattern::end_of_class(std::size_t p) const {
    const unsigned char first = at(p++);
    if (first == '%') {
        if (p >= pattern_.size())
            malformed("it ends with '%'");
        return p + 1;
    }
    if (first != '[')
        return p;
    if (at(p) == '^')
        ++p;
    do {  // a first ']' belongs to the set
        if (p >= pattern_.size())
            malformed("']' is missing");
        if (pattern_[p++] == '%')
            ++p;
    } while (p >= pattern_.size() || pattern_[p] != ']');
    return p + 1;
}

/// `p` is at '[', `last` at the ']'.
bool Pattern::in_set(unsigned char c, std::size_t p, std::size_t last) const {
    bool found = true;
    if (at(p + 1) == '^') {
        found = false;
        ++p;
    }
    while (++p < last) {
        if (at(p) == '%') {
            if (in_class(c, at(++p)))
                return found;
        } else if (at(p + 1) == '-' && p + 2 < last) {
            if (at(p) <= c && c <= at(p + 2))
                return found;
            p += 2;
        } else if (at(p) == c) {
            return found;
        }
    }
    return !found;
}

bool Pattern::matches_one(std::size_t s, std::size_t p, std::size_t after) {
    if (s >= text_.size())
        return false;
    pay_for_class(p, after);
    const auto c = static_cast<unsigned char>(text_[s]);
    switch (at(p)) {
        case '.':
            return true;
        case '%':
            return in_class(c, at(p + 1));
        case '[':
            return in_set(c, p, after - 1);
        default:
            return at(p) == c;
    }
}

Pattern::Place Pattern::match(std::size_t s, std::size_t p) {
    if (++depth_ > deepest)
        throw world::Error("the pattern is too complex");
    Place result;
    bool again = true;
    while (again) {
        step();
        again = false;
        if (p == pattern_.size()) {
            result = s;
            break;
        }
        const unsigned char c = at(p);
        if (c == '(')
            result = at(p + 1) == ')' ? open_capture(s, p + 2, State::position)
                                      : open_capture(s, p + 1, State::open);
        else if (c == ')')
            result = close_capture(s, p + 1);
        else if (c == '$' && p + 1 == pattern_.size())
            result = s == text_.size() ? Place(s) : std::nullopt;
        else if (c == '%')
            result = match_escape(s, p, again);
        else
            result = match_default(s, p, again);
    }
    --depth_;
    return result;
}

/// %b, %f and %1 to %9; other classes as any character. `again`: go on at s and p.
Pattern::Place Pattern::match_escape(std::size_t& s, std::size_t& p, bool& again) {
    const unsigned char letter = at(p + 1);
    Place next;
    if (letter == 'b') {
        next = balance(s, p + 2);
        p += 4;
    } else if (letter == 'f') {
        if (at(p + 2) != '[')
            malformed("'[' is missing after '%f'");
        const std::size_t after = end_of_class(p + 2);
        if (frontier(s, p + 2, after))
            next = s;
        p = after;
    } else if (is_between(letter, '0', '9')) {
        next = repeat_capture(s, letter);
        p += 2;
    } else {
        return match_default(s, p, again);
    }
    again = next.has_value();
    s = next.value_or(s);
    return std::nullopt;
}

Pattern::Place Pattern::match_default(std::size_t& s, std::size_t& p, bool& again) {
    const std::size_t after = end_of_class(p);
    pay_for_class(p, after);
    const unsigned char suffix = at(after);
    const bool repeats = suffix == '*' || suffix == '?' || suffix == '-';
    if (!matches_one(s, p, after)) {
        again = repeats;
        p = after + 1;
        return std::nullopt;
    }
    if (suffix == '?') {
        if (const Place found = match(s + 1, after + 1))
            return found;
        again = true;
        p = after + 1;
        return std::nullopt;
    }
    if (suffix == '+')
        return expand_most(s + 1, p, after);
    if (suffix == '*')
        return expand_most(s, p, after);
    if (suffix == '-')
        return expand_least(s, p, after);
    again = true;
    ++s;
    p = after;
    return std::nullopt;
}

Pattern::Place Pattern::expand_most(std::size_t s, std::size_t p, std::size_t after) {
    std::size_t count = 0;
    while (matches_one(s + count, p, after)) {
        step();
        ++count;
    }
    for (;; --count) {
        if (const Place found = match(s + count, after + 1))
            return found;
        if (count == 0)
            return std::nullopt;
    }
}

Pattern::Place Pattern::expand_least(std::size_t s, std::size_t p, std::size_t after) {
    for (;; ++s) {
        if (const Place found = match(s, after + 1))
            return found;
        if (!matches_one(s, p, after))
            return std::nullopt;
    }
}

Pattern::Place Pattern::open_capture(std::size_t s, std::size_t p, State state) {
    if (level_ >= most_captures)
        throw world::Error("too many captures in a pattern");
    slots_[level_++] = {s, 0, state};
    const Place found = match(s, p);
    if (!found)
        --level_;
    return found;
}

Pattern::Place Pattern::close_capture(std::size_t s, std::size_t p) {
    std::size_t index = level_;
    while (index > 0 && slots_[index - 1].state != State::open)
        --index;
    if (index == 0)
        malformed("')' without '('");
    Slot& slot = slots_[index - 1];
    slot.size = s - slot.start;
    slot.state = State::closed;
    const Place found = match(s, p);
    if (!found)
        slot.state = State::open;
    return found;
}

/// %bxy: x and y, balanced.
Pattern::Place Pattern::balance(std::size_t s, std::size_t p) {
    if (p + 1 >= pattern_.size())
        malformed("'%b' needs two characters");
    if (s >= text_.size() || text_[s] != pattern_[p])
        return std::nullopt;
    int open = 1;
    while (++s < text_.size()) {
        step();
        if (text_[s] == pattern_[p + 1]) {
            if (--open == 0)
                return s + 1;
        } else if (text_[s] == pattern_[p]) {
            ++open;
        }
    }
    return std::nullopt;
}

bool Pattern::frontier(std::size_t s, std::size_t p, std::size_t after) {
    pay_for_class(p, after + 2 * (after - p));  // its end, and two characters
    const auto before = static_cast<unsigned char>(s == 0 ? '\0' : text_[s - 1]);
    const auto here = static_cast<unsigned char>(s < text_.size() ? text_[s] : '\0');
    return !in_set(before, p, after - 1) && in_set(here, p, after - 1);
}

Pattern::Place Pattern::repeat_capture(std::size_t s, unsigned char digit) {
    const std::size_t index = static_cast<std::size_t>(digit) - '1';
    if (digit == '0' || index >= level_ || slots_[index].state == State::open)
        throw world::Error(std::string("invalid capture index %") + static_cast<char>(digit) +
                           " in a pattern");
    const Slot& slot = slots_[index];
    steps_ += slot.size / 8;
    if (text_.size() - s < slot.size ||
        text_.substr(s, slot.size) != text_.substr(slot.start, slot.size))
        return std::nullopt;
    return s + slot.size;
}

std::size_t Pattern::captures(bool whole_if_none) const {
    return level_ == 0 && whole_if_none ? 1 : level_;
}

Pattern::Capture Pattern::capture(std::size_t index, std::size_t start, std::size_t end) const {
    if (index >= level_) {
        if (index != 0)
            throw world::Error("invalid capture index in a replacement");
        return {start, end - start, false};
    }
    const Slot& slot = slots_[index];
    if (slot.state == State::open)
        throw world::Error("unfinished capture in a pattern");
    return {slot.start, slot.size, slot.state == State::position};
}

bool is_plain(std::string_view pattern) {
    return pattern.find_first_of("^$*+?.([%-") == std::string_view::npos;
}

}  // namespace reprise::scripting
