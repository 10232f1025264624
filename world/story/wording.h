#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace reprise::world {

/// "1 check", "2 checks", "0 checks"; `plural` where it is not the word with an s.
std::string count_of(std::uint64_t count, std::string_view word, std::string_view plural = {});

/// "a van", "an adult"; by the letter, not by the sound. Without a vowel it is spelled: "an rgb".
std::string with_article(std::string_view noun);

/// Whole, with commas: "12,300".
std::string with_thousands(double value);

/// With so many decimals, and never "-0.0".
std::string with_decimals(double value, int decimals);

}  // namespace reprise::world
