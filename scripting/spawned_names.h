#pragma once

#include <string_view>

namespace reprise::scripting {

/// May this Lua source (of a scenario, or of a parameter's value) name somebody so, as far as its
/// words say? They do where a text of it is the name, where one that is joined with `..`, or that
/// is a format, begins or ends it, and where it is that of a model, with or without a number, as
/// whom nobody named is called: 'sedan_2'. Comments name nobody.
bool may_name(std::string_view source, std::string_view name);

}  // namespace reprise::scripting
