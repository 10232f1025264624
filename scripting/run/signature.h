#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace reprise::scripting {

/// What a word takes and returns, read out of its row: "(speed: number, options?: T): number".
struct Signature {
    struct Parameter {
        std::string name;  ///< "..." of as many as one likes
        std::string type;  ///< as the Lua language server writes it
        bool optional = false;
    };

    std::vector<Parameter> parameters;
    std::vector<std::string> returns;  ///< types
};

Signature read_signature(std::string_view text);

/// Parts of a type at the commas or bars that stand in no bracket: "'left'|'right'|LaneName".
std::vector<std::string> split_type(std::string_view type, char separator);

}  // namespace reprise::scripting
