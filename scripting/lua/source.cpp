#include "scripting/lua/source.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scripting/lua/hash.h"
#include "scripting/lua/memory.h"
#include "scripting/lua/tokens.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr std::size_t longest_source = std::size_t{1} << 20U;  // [bytes]
constexpr std::size_t deepest = 190;                           // of Lua's 200 calls in C
constexpr std::uint64_t most_branches = 10'000;                // 0.2 s when all are one expression
constexpr std::uint64_t most_lookups = 150'000'000;            // variables passed; about 3 ns each
constexpr std::uint64_t most_key_steps = 50'000'000;           // entries passed; about 3 ns each

using Kind = Token::Kind;

/// Lua's table of all names, texts and numbers of a source: how many entries a look-up passes.
/// Entries with equal main positions form a chain; twice as many positions when all are taken.
class KeyTable {
  public:
    /// `divides`: a number's hash is taken modulo the size less one, a text's has its bits cut.
    struct Key {
        std::uint64_t hash;
        bool divides;
    };

    std::uint64_t passed_by(const Key& key) const { return counts_[place(key)]; }

    /// How many entries were passed.
    std::uint64_t add(const Key& key) {
        std::uint64_t passed = 0;
        keys_.push_back(key);
        if (keys_.size() > counts_.size()) {
            counts_.assign(2 * counts_.size(), 0);
            for (const Key& each : keys_)
                passed += counts_[place(each)]++;
        } else {
            passed = counts_[place(key)]++;
        }
        return passed;
    }

  private:
    std::size_t place(const Key& key) const {
        const std::size_t size = counts_.size();
        return key.divides ? key.hash % ((size - 1) | 1U) : key.hash & (size - 1);
    }

    std::vector<Key> keys_;
    std::vector<std::uint32_t> counts_ = std::vector<std::uint32_t>(256, 0);
};

/// As Lua 5.4 hashes a float: by 31 bits of its mantissa.
std::uint32_t hash_of(double number) {
    int exponent = 0;
    const double scaled = std::frexp(number, &exponent) * 0x1p31;
    if (!(scaled >= -0x1p63 && scaled < 0x1p63))
        return 0;
    const auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(scaled));
    const std::uint32_t hash = static_cast<std::uint32_t>(exponent) + bits;
    return hash <= 0x7fffffffU ? hash : ~hash;
}

/// A whole number that fits; hexadecimal ones wrap around.
bool read_integer(std::string_view digits, std::uint64_t& value) {
    const bool hexadecimal = digits.size() > 2 && (digits[1] | ' ') == 'x';
    if (hexadecimal) {
        digits.remove_prefix(2);
        digits.remove_prefix(digits.size() - std::min<std::size_t>(digits.size(), 16));
    }
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, value, hexadecimal ? 16 : 10);
    return read.ec == std::errc() && read.ptr == end && (hexadecimal || value <= INT64_MAX);
}

class SourceCheck {
  public:
    SourceCheck(std::string_view source, const std::string& script)
        : tokens_(source),
          script_(script) {}

    void run() {
        open(true);  // the file is a function
        Token token;
        for (Token before = token; (token = tokens_.next()).kind != Kind::end; before = token) {
            line_ = token.line;
            if (token.spelling.size() > longest_text && token.kind != Kind::number)
                refuse("a name or text of more than 64 kB: keep it in parts");
            if (token.kind == Kind::name || token.kind == Kind::symbol)
                count_word(token.spelling);
            if (token.kind == Kind::name && before.spelling != "." && before.spelling != ":")
                count_lookup();
            if (token.kind == Kind::name || token.kind == Kind::text)
                count_text(token.spelling);
            if (token.kind == Kind::number)
                count_number(token.spelling);
        }
    }

  private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw world::Error(fmt::format("{}:{}: {}", script_, line_, what));
    }

    /// Each is a jump, and Lua walks along all jumps of an expression to add one; labels and gotos
    /// it looks for among all.
    void count_word(std::string_view word) {
        constexpr std::array<std::string_view, 6> jumps{
            "and", "or", "elseif", "goto", "break", "::"};
        if (std::find(jumps.begin(), jumps.end(), word) != jumps.end() &&
            ++branches_ > most_branches)
            refuse("more than 10,000 of 'and', 'or', 'elseif', 'break' and 'goto' in one file");
        if (word == "function" || word == "if" || word == "do" || word == "repeat")
            open(word == "function");
        if ((word == "end" || word == "until") && blocks_.size() > 1)
            close();
        if (word == "(" || word == "{" || word == "[")
            ++brackets_;
        else if ((word == ")" || word == "}" || word == "]") && brackets_ > 0)
            --brackets_;
        if (blocks_.size() + brackets_ > deepest)
            refuse("blocks and brackets are nested more than 190 deep");
    }

    void open(bool function) {
        blocks_.push_back(function);
        if (function)
            names_.push_back(0);
    }

    void close() {
        if (blocks_.back()) {
            passed_ -= names_.back();
            names_.pop_back();
        }
        blocks_.pop_back();
    }

    /// A variable is looked for in every function around it, among its locals and what it holds of
    /// others: no more than were named there.
    void count_lookup() {
        constexpr std::uint64_t most_locals = 200;
        constexpr std::uint64_t most_held = 255;
        const std::uint64_t most = names_.size() == 1 ? most_locals : most_locals + most_held;
        if (names_.back() < most) {
            ++names_.back();
            ++passed_;
        }
        lookups_ += passed_;
        if (lookups_ > most_lookups)
            refuse("too many variables in functions inside functions: write fewer, or shorter");
    }

    void count_text(std::string_view text) {
        // What stands for something else is taken as if all such texts had the same hash.
        const bool escaped = text.find('\\') != std::string_view::npos;
        const KeyTable::Key key{escaped ? 0 : text_hash(text), false};
        const bool is_new = texts_.insert(text).second;
        for (KeyTable* table : {&all_, &interned_})
            count_key(is_new ? table->add(key) : table->passed_by(key));
    }

    void count_number(std::string_view spelling) {
        constexpr std::uint64_t largest_operand = 65'535;  // held by an instruction itself
        std::uint64_t value = 0;
        KeyTable::Key key{0, true};
        const bool whole = read_integer(spelling, value);
        if (whole && value <= largest_operand)
            return;
        if (!whole) {
            const double number = std::strtod(std::string(spelling).c_str(), nullptr);
            std::memcpy(&value, &number, sizeof value);
            key.hash = hash_of(number);
        } else {
            key.hash = value;
        }
        const bool is_new = numbers_.emplace(whole, value).second;
        count_key(is_new ? all_.add(key) : all_.passed_by(key));
    }

    void count_key(std::uint64_t passed) {
        key_steps_ += passed;
        if (key_steps_ > most_key_steps)
            refuse("too many names, texts or numbers whose hashes agree");
        if (texts_.size() + numbers_.size() > most_keys)
            refuse("more than 65,536 different names, texts and numbers in one file");
    }

    Tokens tokens_;
    const std::string& script_;
    std::uint32_t line_ = 1;
    std::uint64_t branches_ = 0;
    std::size_t brackets_ = 0;          ///< that are open
    std::vector<bool> blocks_;          ///< that are open: is it a function?
    std::vector<std::uint64_t> names_;  ///< in each open function
    std::uint64_t passed_ = 0;          ///< their sum
    std::uint64_t lookups_ = 0;
    std::set<std::string_view> texts_;  ///< ordered: no hash of ours can be aimed at
    std::set<std::pair<bool, std::uint64_t>> numbers_;
    KeyTable all_;       ///< the compiler's own
    KeyTable interned_;  ///< the machine's, of texts only
    std::uint64_t key_steps_ = 0;
};

}  // namespace

void check_source(std::string_view source, const std::string& script) {
    if (source.size() > longest_source)
        throw world::Error(script + ": more than 1 MB: not a scenario");
    SourceCheck(source, script).run();
}

}  // namespace reprise::scripting
