#include "scripting/run/word.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lua.hpp>

#include "scripting/lua/sandbox.h"
#include "scripting/lua/vm.h"
#include "scripting/words/vocabulary.h"
#include "tests/scripting/stage.h"

namespace reprise::scripting {

namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

/// The keys of the table at the top of the stack, sorted; it is popped.
std::vector<std::string> keys_at_top(lua_State* L) {
    std::vector<std::string> keys;
    for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1))
        keys.emplace_back(lua_tostring(L, -2));
    lua_pop(L, 1);
    std::sort(keys.begin(), keys.end());
    return keys;
}

/// A machine as a scenario meets it, and what it had before it knew any word of ours.
struct Machine {
    explicit Machine(bool in_branch) {
        vm.in_branch = in_branch;
        lua_State* L = vm.main();
        push_sandbox(L);  // vocabulary, environment
        lua_pushvalue(L, -2);
        lua_pushvalue(L, -1);
        plain = keys_at_top(L);
        add_vocabulary(L);
        lua_pop(L, 1);
        vm.execute(prelude_source, "=prelude", -2);
        lua_pop(L, 1);
    }

    std::vector<std::string> words(Owner owner) {
        lua_State* L = vm.main();
        if (owner == Owner::actor) {
            luaL_getmetatable(L, "actor");
            lua_getfield(L, -1, "__index");
            lua_remove(L, -2);
            return keys_at_top(L);
        }
        lua_pushvalue(L, 1);
        if (owner == Owner::check) {
            lua_getfield(L, -1, "check");
            lua_remove(L, -2);
            return keys_at_top(L);
        }
        std::vector<std::string> added;
        for (const std::string& key : keys_at_top(L))
            if (key != "check" && !std::binary_search(plain.begin(), plain.end(), key))
                added.push_back(key);
        return added;
    }

    Vm vm{"test.lua"};
    std::vector<std::string> plain;
};

std::vector<std::string> rows(Owner owner, bool in_branch) {
    std::vector<std::string> names;
    for (const WordList& list : vocabulary())
        if (list.owner == owner && (in_branch || list.words.data() != branch_words.words.data()))
            for (const Word& word : list.words)
                names.emplace_back(word.name);
    std::sort(names.begin(), names.end());
    return names;
}

bool is_balanced(const std::string& text) {
    return std::count(text.begin(), text.end(), '(') == std::count(text.begin(), text.end(), ')') &&
           std::count(text.begin(), text.end(), '{') == std::count(text.begin(), text.end(), '}');
}

}  // namespace

TEST(Vocabulary, HasARowForEveryWordOfTheMachineAndNoOther) {
    for (const bool in_branch : {false, true}) {
        Machine machine(in_branch);
        for (const Owner owner : {Owner::global, Owner::actor, Owner::check})
            EXPECT_THAT(rows(owner, in_branch), ElementsAreArray(machine.words(owner)))
                << "owner " << static_cast<int>(owner) << ", in a branch: " << in_branch;
    }
}

TEST(Vocabulary, SaysOfEveryWordWhatItTakesAndWhatItMeans) {
    for (const WordList& list : vocabulary())
        for (const Word& word : list.words) {
            SCOPED_TRACE(word.name);
            const std::string signature = word.signature;
            EXPECT_EQ(signature.front(), '(');
            EXPECT_TRUE(is_balanced(signature)) << signature;
            EXPECT_NE(std::string(word.meaning), "");
            EXPECT_EQ(std::string(word.meaning).find('\n'), std::string::npos);
            EXPECT_NE(std::string(word.meaning).back(), '.') << "a row of a table, no sentence";
        }
}

TEST(Vocabulary, NamesTheTypeOfEveryTableInASignature) {
    std::string signatures;
    for (const WordList& list : vocabulary())
        for (const Word& word : list.words)
            signatures += word.signature;
    for (const KeyList& list : vocabulary_keys())
        for (const Key& key : list.keys)
            signatures += key.type;
    for (const KeyList& list : vocabulary_keys())
        EXPECT_THAT(signatures, HasSubstr(list.type)) << list.word;
}

TEST(Vocabulary, ListsTheKeysThatAWordTakes) {
    const std::string message = test::mistake("spawn{ qqqqqqqq = 1 }");
    for (const Key& key : spawn_keys.keys)
        EXPECT_THAT(message, HasSubstr(key.name));
}

}  // namespace reprise::scripting
