#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct lua_State;

namespace reprise::scripting {

/// A word of the scenario language: what Lua calls, and what people and editors are told of it.
/// Adding a word is adding its row to the table of its family.
struct Word {
    const char* name;
    int (*function)(lua_State*);  ///< null: scripting/lua/prelude.lua defines it
    /// As the Lua language server writes types, without the actor itself:
    /// "(speed: number, options?: OverOptions)", "(): number, number".
    const char* signature;
    const char* meaning;  ///< one line, units in brackets
};

/// Who has the word: everybody (`wait`), an actor (`ego:speed`), the table `check`, what `start`
/// gives back (`task:cancel`).
enum class Owner : std::uint8_t { global, actor, check, task };

/// A family of words.
struct WordList {
    Owner owner;
    const char* group;  ///< as a heading
    std::span<const Word> words;
};

/// A key of a table that a word takes: `lane` of `spawn{ lane = 'main_1' }`.
struct Key {
    const char* name;
    const char* type;     ///< as the Lua language server writes it
    const char* meaning;  ///< one line, units in brackets, default
    bool required = false;
};

/// All keys of one table.
struct KeyList {
    const char* type;  ///< what signatures call it: "SpawnOptions"
    const char* word;  ///< who takes it, for readers: "spawn"
    std::span<const Key> keys;
};

/// Registers the words of a family in the table at the top of the stack.
void add_words(lua_State* L, const WordList& list);

/// For `Fields`: what there may be.
std::vector<std::string> names_of(std::span<const Key> keys);

}  // namespace reprise::scripting
