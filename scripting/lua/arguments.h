#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct lua_State;

namespace reprise::scripting {

/// "who: message" as world::Error; the binding adds file and line.
[[noreturn]] void refuse(std::string_view who, const std::string& message);

/// The argument as a finite number, or refuses: "wait: seconds must be a number, got nil".
double number_at(lua_State* L, int index, std::string_view who, std::string_view what);
std::int64_t integer_at(lua_State* L, int index, std::string_view who, std::string_view what);
std::string text_at(lua_State* L, int index, std::string_view who, std::string_view what);

/// A text of 1 to 100 characters, fit to be shown.
std::string name_at(lua_State* L, int index, std::string_view who, std::string_view what);
void want_function(lua_State* L, int index, std::string_view who, std::string_view what);

/// Keys of a table as vocabulary: knows which there may be, refuses others with a suggestion.
class Fields {
  public:
    /// Without a table at `index` (none or nil) every key is absent, if `optional`.
    Fields(lua_State* L,
           int index,
           std::string who,
           std::vector<std::string> allowed,
           bool optional = false);

    bool has(const char* key) const;

    /// As has(), for words that are seldom said: Lua does not learn the key, so runs that do not
    /// say it stay equal to those of before there was the word.
    bool mentions(std::string_view key) const;

    std::optional<double> number(const char* key) const;  ///< finite
    std::optional<std::int64_t> integer(const char* key) const;
    std::optional<std::string> text(const char* key) const;
    std::optional<std::string> name(const char* key) const;  ///< as name_at
    std::optional<bool> flag(const char* key) const;

    /// [m/s] from `speed`, or from `speed_kmh`; not below 0.
    std::optional<double> speed() const;

    /// Pushes the value; nil when absent.
    void push(const char* key) const;

    const std::string& who() const { return who_; }

  private:
    void refuse_others(const std::vector<std::string>& allowed) const;

    lua_State* L_;
    int index_;  ///< 0: no table
    std::string who_;
};

}  // namespace reprise::scripting
