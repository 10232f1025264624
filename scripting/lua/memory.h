#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "scripting/lua/arena.h"
#include "scripting/lua/chains.h"

namespace reprise::scripting {

/// Bytes that a scenario's values may take; Vm looks every 1000 instructions, and what nobody holds
/// is collected first. Twice as much is refused at once.
inline constexpr std::size_t memory_cap = std::size_t{64} << 20U;

inline constexpr std::size_t longest_text = std::size_t{64} << 10U;  ///< [bytes]
inline constexpr std::size_t most_values = 65'536;  ///< on one task's stack: calls and arguments
inline constexpr std::size_t most_keys = 65'536;    ///< of one table, its list part aside

/// What a scenario has used, in VM instructions.
struct Account {
    std::uint64_t all = 0;
    std::uint64_t in_tick = 0;

    void take(std::uint64_t instructions) {
        all += instructions;
        in_tick += instructions;
    }
};

/// All memory of one Lua machine: limits, and what its use costs.
///
/// What must it do?   Refuse what is too much, at the same request in every process; charge the
///                    account for work that Lua does outside of its instructions (filling a long
///                    text, rebuilding a table), which nearly always asks for memory first.
/// What does it assume? Lua 5.4.4: a thread's block is followed by the block of its stack; a stack
/// that
///                    grows is copied into the block asked for just before the old one is released;
///                    the key part of a table takes 24 bytes times a power of two; a table that is
///                    rebuilt asks for its list part again, even at the same size.
/// What does it keep? The bytes asked for, and which long texts, stacks and tables are alive: one
///                    instruction on those (a == b, f(...), t[key]) can take as long as they are.
class Memory {
  public:
    enum class Refusal : std::uint8_t { none, cap, text, stack, table };

    explicit Memory(Account& account) : account_(account) {}

    /// Lua's allocator. Null: refused. `type`: of a new block's value, as Lua says it.
    void* resize(void* block, std::size_t old_size, int type, std::size_t new_size);

    /// Why the run must end; since it was asked last.
    Refusal refusal();

    /// Where the machine keeps its short texts; must outlive this.
    void watch(const TextTable& texts) { text_table_ = &texts; }

    /// Called every so many instructions: looks now and then whether keys or short texts were
    /// chosen so that their hashes agree, the more of them the more often. Charged.
    void inspect();

    /// What an instruction may cost with what is alive now, in plain instructions; at least 1.
    std::uint64_t rate() const { return rate_; }

    /// [bytes] at most, of the largest block alive: how long a walk over a table can take.
    std::size_t largest_block() const;

    std::size_t bytes() const { return bytes_; }

    /// Since the start: blocks asked for.
    std::uint64_t requests() const { return requests_; }

  private:
    Refusal objection(bool is_new, int type, std::size_t held, std::size_t new_size) const;
    void follow_stack(const void* released);
    void remember(void* block, int type, std::size_t size);
    void forget(void* block, std::size_t size);
    void charge(int type, std::size_t old_size, std::size_t new_size);
    void remember_keys(const void* block, std::size_t size);
    void forget_keys(const void* block);
    void inspect_texts();
    void set_rate();

    Account& account_;
    Arena arena_;
    std::size_t bytes_ = 0;
    std::uint64_t requests_ = 0;
    Refusal refusal_ = Refusal::none;
    bool stack_is_next_ = false;
    void* newest_ = nullptr;  ///< the block of the last request, when it was a new one
    std::size_t newest_size_ = 0;
    std::uint64_t rate_ = 1;
    // Found by address, never walked.
    std::unordered_map<const void*, std::size_t> texts_;   ///< long ones -> size
    std::unordered_map<const void*, std::size_t> stacks_;  ///< -> size
    std::map<std::size_t, std::uint32_t> text_sizes_;      ///< size -> how many
    std::map<std::size_t, std::uint32_t> stack_sizes_;

    struct KeyPart {
        std::size_t size = 0;
        std::uint64_t due = 0;  ///< for inspection, in calls of inspect()
        std::size_t chain = 1;
    };

    std::unordered_map<const void*, KeyPart> key_parts_;  ///< large ones; found by address too
    std::set<std::pair<std::uint64_t, const void*>>
        due_;                                      ///< of them, what one finds touches no other
    std::map<std::size_t, std::uint32_t> chains_;  ///< their longest ones -> how many
    std::uint64_t inspections_ = 0;
    const TextTable* text_table_ = nullptr;
    std::uint64_t new_texts_ = 0;             ///< short ones, since they were last looked at
    std::uint64_t texts_looked_at_ = 0;       ///< then, in calls of inspect()
    std::size_t text_chain_ = 1;              ///< the longest one then
    std::array<std::uint32_t, 64> blocks_{};  ///< large ones, by the bits of their size
};

}  // namespace reprise::scripting
