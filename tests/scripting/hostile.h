#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace reprise::test {

/// A scenario file that was written to take as long, or as much, as it can.
struct Hostile {
    std::string name;
    std::string source;
    std::string message;  ///< of the mistake it ends with, a part; empty: it ends as others do
};

/// How gtest shows it.
void PrintTo(const Hostile& script, std::ostream* out);

std::vector<Hostile> hostile_loads();  ///< to the compiler
std::vector<Hostile> hostile_works();  ///< to a tick's budget
std::vector<Hostile> hostile_texts();  ///< to it as well: texts, patterns and numbers
std::vector<Hostile> hostile_asks();   ///< to the world

/// The text so many times.
std::string times(int count, const std::string& text);

inline constexpr const char* spent_in_a_tick = "more than 10,000,000 instructions in one tick";
inline constexpr const char* spent_in_a_load =
    "more than 2,500,000 instructions before the first tick";

}  // namespace reprise::test
