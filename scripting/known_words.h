#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scripting/run/signature.h"
#include "scripting/run/word.h"
#include "world/town_generated.h"

namespace reprise::scripting {

using Names = std::set<std::string, std::less<>>;

std::vector<std::string> list_of(const Names& names);

/// "a, b, c"
std::string joined(const std::vector<std::string>& words);

/// What Lua itself has here: its globals, and the fields of its libraries.
struct Libraries {
    Libraries();

    Names globals;
    std::map<std::string, Names, std::less<>> fields;
};

/// The vocabulary by owner and name.
struct Language {
    Language();

    /// Null when there is no such word.
    const Signature* find(Owner owner, std::string_view name) const;

    /// What is wrong with a text where a value of this type is wanted, if that can be said. Lanes
    /// are looked up in `town`, if any.
    std::optional<std::string> mistake_in(const std::string& text,
                                          const std::string& type,
                                          const world::TownT* town) const;

    std::map<Owner, std::map<std::string, Signature, std::less<>>> words;
    std::map<Owner, Names> names;
    /// Of each type of table: key, type of its value.
    std::map<std::string, std::map<std::string, std::string, std::less<>>, std::less<>> keys;
    Signature header;  ///< of the call with the table, behind scenario 'name'
};

}  // namespace reprise::scripting
