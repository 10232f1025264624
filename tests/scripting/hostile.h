#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace reprise::test {

/// A text that is made when it is asked for. gtest wants the scripts of all parameters before it
/// runs any test: a hundred texts of up to a megabyte, in each process that runs another test.
class LazyText {
  public:
    LazyText(const char* text) : LazyText(std::string(text)) {}

    LazyText(std::string text) : make_([text = std::move(text)] { return text; }) {}

    LazyText(std::function<std::string()> make) : make_(std::move(make)) {}

    std::string made() const { return make_(); }

    friend LazyText operator+(const LazyText& first, const LazyText& second) {
        return std::function<std::string()>(
            [first, second] { return first.made() + second.made(); });
    }

  private:
    std::function<std::string()> make_;
};

/// A scenario file that was written to take as long, or as much, as it can.
struct Hostile {
    std::string name;
    LazyText source;
    std::string message;  ///< of the mistake it ends with, a part; empty: it ends as others do
};

/// How gtest shows it.
void PrintTo(const Hostile& script, std::ostream* out);

std::vector<Hostile> hostile_loads();  ///< to the compiler
std::vector<Hostile> hostile_works();  ///< to a tick's budget
std::vector<Hostile> hostile_texts();  ///< to it as well: texts, patterns and numbers
std::vector<Hostile> hostile_asks();   ///< to the world

/// The text so many times.
LazyText times(int count, const LazyText& text);

inline constexpr const char* spent_in_a_tick = "more than 10,000,000 instructions in one tick";
inline constexpr const char* spent_in_a_load =
    "more than 2,500,000 instructions before the first tick";

}  // namespace reprise::test
