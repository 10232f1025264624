#include "scripting/lua/memory.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include <lua.hpp>

#include "scripting/lua/chains.h"

namespace reprise::scripting {

namespace {

constexpr std::size_t slot = 16;        // [bytes] of a value on a stack or in a list
constexpr std::size_t short_text = 64;  // [bytes] shorter ones Lua may already hold: no charge
constexpr std::size_t longest_interned = 65;  // [bytes] of a text that Lua holds once
constexpr std::size_t large_block = 512;      // [bytes] from here on a block costs by its size

// From here on instructions on it cost more: measured, an instruction then takes about 0.1 us.
constexpr std::size_t cheap_text = 256;   // [bytes] `for i = 1, text` reads all of it as a number
constexpr std::size_t cheap_stack = 512;  // slots; `f(...)` copies all of them
constexpr std::size_t cheap_chain = 16;   // `t[key]` passes all keys with the same hash
constexpr std::size_t large_keys =
    256;  // entries; smaller tables cost nothing to rebuild and look at
constexpr std::size_t watched_keys = 64;  // entries; smaller ones have short chains at any rate

bool is_key_part(std::size_t size, std::size_t least_keys) {
    return size >= least_keys * key_slot && size % key_slot == 0 &&
           std::has_single_bit(size / key_slot);
}

/// Until keys in such a part are looked at again, in calls of inspect(): a chain of all of them
/// then costs a tenth of a second at most.
std::uint64_t interval(std::size_t size) {
    constexpr std::size_t entries_times_calls = 32'768;
    return std::max<std::uint64_t>(4, entries_times_calls / (size / key_slot));
}

/// [instructions] of a new function: each variable that it holds is looked for among those that
/// others hold.
std::uint64_t cost_of_closure(std::size_t size) {
    constexpr std::size_t few = 16;
    const std::size_t held = size / sizeof(void*);
    return held <= few ? 0 : held * held / 32;
}

void add(std::map<std::size_t, std::uint32_t>& sizes, std::size_t size) {
    ++sizes[size];
}

void remove_size(std::map<std::size_t, std::uint32_t>& sizes, std::size_t size) {
    const auto found = sizes.find(size);
    if (--found->second == 0)
        sizes.erase(found);
}

std::size_t largest(const std::map<std::size_t, std::uint32_t>& sizes) {
    return sizes.empty() ? 0 : sizes.rbegin()->first;
}

}  // namespace

Memory::Refusal Memory::refusal() {
    return std::exchange(refusal_, Refusal::none);
}

std::size_t Memory::largest_block() const {
    for (std::size_t bits = blocks_.size(); bits-- > 0;)
        if (blocks_[bits] != 0)
            return std::size_t{1} << bits;
    return large_block;
}

Memory::Refusal Memory::objection(bool is_new,
                                  int type,
                                  std::size_t held,
                                  std::size_t new_size) const {
    if (is_new && type == LUA_TSTRING && new_size > longest_text + 64)
        return Refusal::text;
    if (is_new && new_size > most_keys * key_slot && is_key_part(new_size, large_keys))
        return Refusal::table;
    return bytes_ - held + new_size > 2 * memory_cap ? Refusal::cap : Refusal::none;
}

void* Memory::resize(void* block, std::size_t old_size, int type, std::size_t new_size) {
    const std::size_t held = block == nullptr ? 0 : old_size;
    if (new_size == 0) {
        if (block == nullptr)
            return nullptr;
        follow_stack(block);
        forget(block, held);
        arena_.release(block, held);
        bytes_ -= held;
        return nullptr;
    }
    ++requests_;
    charge(block == nullptr ? type : LUA_TNIL, held, new_size);
    Refusal objection = Refusal::none;
    void* moved = nullptr;
    if (new_size > held)
        objection = this->objection(block == nullptr, type, held, new_size);
    if (objection == Refusal::none) {
        moved = arena_.resize(block, held, new_size);
        if (moved == nullptr)
            objection = Refusal::cap;
    }
    if (moved == nullptr) {
        newest_ = nullptr;
        refusal_ = objection;
        return nullptr;
    }
    bytes_ += new_size - held;
    if (block != nullptr)
        forget(block, held);
    remember(moved, block == nullptr ? type : LUA_TNIL, new_size);
    newest_ = block == nullptr ? moved : nullptr;
    newest_size_ = new_size;
    return moved;
}

/// A stack is released: it died with its thread, or was just copied into the newest block, its
/// lowest function included.
void Memory::follow_stack(const void* released) {
    const void* const newest = std::exchange(newest_, nullptr);
    if (newest == nullptr || newest_size_ < 2 * slot || stacks_.count(released) == 0 ||
        std::memcmp(static_cast<const std::byte*>(newest) + slot,
                    static_cast<const std::byte*>(released) + slot,
                    sizeof(void*)) != 0)
        return;
    stacks_.emplace(newest, newest_size_);
    add(stack_sizes_, newest_size_);
    if (newest_size_ > most_values * slot)
        refusal_ = Refusal::stack;
}

/// Filling a text takes about 2 ns a byte, moving a block or counting a list less.
void Memory::charge(int type, std::size_t old_size, std::size_t new_size) {
    if (type == LUA_TSTRING) {
        if (new_size > short_text)
            account_.take(new_size / 8);
        if (new_size <= longest_interned)
            ++new_texts_;
        return;
    }
    if (type == LUA_TFUNCTION)
        account_.take(cost_of_closure(new_size));
    const std::size_t size = std::max(old_size, new_size);
    if (size >= large_block)
        account_.take(is_key_part(size, large_keys)
                          ? size / 3 * std::max<std::size_t>(1, largest(chains_) / 64)
                          : size / 32);
}

void Memory::remember(void* block, int type, std::size_t size) {
    if (std::exchange(stack_is_next_, type == LUA_TTHREAD)) {
        stacks_.emplace(block, size);
        add(stack_sizes_, size);
    }
    if (size < large_block)
        return;
    ++blocks_[static_cast<std::size_t>(std::bit_width(size))];
    if (type == LUA_TSTRING && size > cheap_text) {
        texts_.emplace(block, size);
        add(text_sizes_, size);
    }
    if (is_key_part(size, watched_keys))
        remember_keys(block, size);
    set_rate();
}

void Memory::forget(void* block, std::size_t size) {
    if (size < large_block)
        return;
    --blocks_[static_cast<std::size_t>(std::bit_width(size))];
    if (texts_.erase(block) != 0)
        remove_size(text_sizes_, size);
    if (stacks_.erase(block) != 0)
        remove_size(stack_sizes_, size);
    if (is_key_part(size, watched_keys))
        forget_keys(block);
    set_rate();
}

void Memory::inspect() {
    ++inspections_;
    while (!due_.empty() && due_.begin()->first <= inspections_) {
        const void* const block = due_.begin()->second;
        due_.erase(due_.begin());
        KeyPart& part = key_parts_.at(block);
        const std::size_t entries = part.size / key_slot;
        remove_size(chains_, part.chain);
        part.chain = longest_chain(block, entries);
        add(chains_, part.chain);
        part.due = inspections_ + interval(part.size);
        due_.emplace(part.due, block);
        if (entries >= large_keys)
            account_.take(entries / 4);
        set_rate();
    }
    inspect_texts();
}

/// Of short texts Lua looks for every new one among those of the same hash.
void Memory::inspect_texts() {
    constexpr std::uint64_t few = 64;       // new ones make no long chain
    constexpr std::uint64_t many = 1024;    // enough for a long one
    constexpr std::uint64_t patience = 64;  // [calls of inspect()]
    if (text_table_ == nullptr)
        return;
    const bool soon =
        new_texts_ >= std::max(many, static_cast<std::uint64_t>(text_table_->count) / 4);
    const bool now = inspections_ >= texts_looked_at_ + patience &&
                     (new_texts_ >= few || text_chain_ >= cheap_chain);
    if (!soon && !now)
        return;
    new_texts_ = 0;
    texts_looked_at_ = inspections_;
    text_chain_ = longest_chain(*text_table_);
    set_rate();
}

void Memory::remember_keys(const void* block, std::size_t size) {
    const KeyPart part{size, inspections_ + interval(size), 1};
    key_parts_.emplace(block, part);
    due_.emplace(part.due, block);
    add(chains_, part.chain);
}

void Memory::forget_keys(const void* block) {
    const auto found = key_parts_.find(block);
    due_.erase({found->second.due, block});
    remove_size(chains_, found->second.chain);
    key_parts_.erase(found);
}

void Memory::set_rate() {
    rate_ = std::max({std::size_t{1},
                      (largest(text_sizes_) + cheap_text - 1) / cheap_text,
                      largest(stack_sizes_) / (cheap_stack * slot),
                      largest(chains_) / cheap_chain,
                      text_chain_ / cheap_chain});
}

}  // namespace reprise::scripting
