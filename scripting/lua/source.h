#pragma once

#include <string>
#include <string_view>

namespace reprise::scripting {

/// Refuses source that Lua's compiler would take too long over: its time is not linear in `and`,
/// `or`, `elseif`, `goto`, in variables of functions inside functions, and in names and numbers
/// whose hashes agree. Throws world::Error with the line at which it becomes too much. O(n log n),
/// 20 ms for the longest source.
void check_source(std::string_view source, const std::string& script);

}  // namespace reprise::scripting
