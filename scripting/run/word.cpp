#include "scripting/run/word.h"

#include "scripting/lua/binding.h"

namespace reprise::scripting {

void add_words(lua_State* L, const WordList& list) {
    for (const Word& word : list.words)
        if (word.function != nullptr)
            add_function(L, word.name, word.function);
}

std::vector<std::string> names_of(std::span<const Key> keys) {
    std::vector<std::string> names;
    for (const Key& key : keys)
        names.emplace_back(key.name);
    return names;
}

}  // namespace reprise::scripting
