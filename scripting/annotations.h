#pragma once

#include <string>

namespace reprise::scripting {

/// The whole vocabulary as annotations for the Lua language server: an editor that finds this text
/// in a file beside a scenario completes `ego:`, the keys of spawn{ } and of the header, the names
/// of models and weathers, and says what a word means. Valid Lua, which nobody runs.
std::string annotations();

/// The same as a page for readers, in Markdown.
std::string words_page();

}  // namespace reprise::scripting
