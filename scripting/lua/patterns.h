#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace reprise::scripting {

/// Lua's patterns (reference manual, 6.4.1), matched by Lua's own method, with three differences:
/// every step is paid for, because matching backtracks and takes n^k steps for k repetitions in n
/// characters; character classes are ASCII, whatever the locale; a mistake in a pattern is a
/// world::Error.
class Pattern {
  public:
    struct Capture {
        std::size_t start = 0;
        std::size_t size = 0;
        bool is_position = false;  ///< of `()`: only where
    };

    /// Both texts must outlive it. `pay` is called now and then with the steps since the last call.
    Pattern(std::string_view text,
            std::string_view pattern,
            std::function<void(std::uint64_t)> pay);

    /// The end of a match that begins at this place. None when there is none.
    std::optional<std::size_t> match_at(std::size_t start);

    /// Starts with '^', which is taken off: it matches at the first place only.
    bool is_anchored() const { return anchored_; }

    /// Of the last match; at least one: without captures the whole match.
    std::size_t captures(bool whole_if_none = true) const;
    Capture capture(std::size_t index, std::size_t start, std::size_t end) const;

    /// Pays for the steps so far.
    void settle();

  private:
    static constexpr std::size_t most_captures = 32;
    static constexpr int deepest = 200;

    enum class State : std::uint8_t { open, closed, position };

    struct Slot {
        std::size_t start = 0;
        std::size_t size = 0;
        State state = State::open;
    };

    using Place = std::optional<std::size_t>;

    void step();
    void pay_for_class(std::size_t p, std::size_t after);
    Place match(std::size_t s, std::size_t p);
    Place match_default(std::size_t& s, std::size_t& p, bool& again);
    Place match_escape(std::size_t& s, std::size_t& p, bool& again);
    Place expand_most(std::size_t s, std::size_t p, std::size_t after);
    Place expand_least(std::size_t s, std::size_t p, std::size_t after);
    Place open_capture(std::size_t s, std::size_t p, State state);
    Place close_capture(std::size_t s, std::size_t p);
    Place balance(std::size_t s, std::size_t p);
    Place repeat_capture(std::size_t s, unsigned char digit);
    bool frontier(std::size_t s, std::size_t p, std::size_t after);
    bool matches_one(std::size_t s, std::size_t p, std::size_t after);
    bool in_set(unsigned char c, std::size_t p, std::size_t last) const;
    std::size_t end_of_class(std::size_t p) const;
    unsigned char at(std::size_t p) const;

    std::string_view text_;
    std::string_view pattern_;
    std::function<void(std::uint64_t)> pay_;
    bool anchored_ = false;
    std::uint64_t steps_ = 0;
    int depth_ = 0;
    std::size_t level_ = 0;  ///< captures so far, open ones included
    std::array<Slot, most_captures> slots_{};
};

/// No character of the pattern means anything but itself.
bool is_plain(std::string_view pattern);

}  // namespace reprise::scripting
