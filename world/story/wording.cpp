#include "world/story/wording.h"

#include <fmt/format.h>

namespace reprise::world {

std::string count_of(std::uint64_t count, std::string_view word, std::string_view plural) {
    if (count == 1)
        return fmt::format("1 {}", word);
    return plural.empty() ? fmt::format("{} {}s", count, word)
                          : fmt::format("{} {}", count, plural);
}

std::string with_article(std::string_view noun) {
    constexpr std::string_view vowels = "aeiouyAEIOUY";
    constexpr std::string_view begin_with_a_vowel = "aefhilmnorsxAEFHILMNORSX";  // when spelled
    const bool spelled = noun.find_first_of(vowels) == std::string_view::npos;
    const std::string_view an = spelled ? begin_with_a_vowel : "aeiouAEIOU";
    const bool is_vowel = !noun.empty() && an.find(noun.front()) != std::string_view::npos;
    return fmt::format("{} {}", is_vowel ? "an" : "a", noun);
}

std::string with_thousands(double value) {
    const std::string digits = with_decimals(value, 0);
    const std::size_t first = digits.starts_with('-') ? 1 : 0;
    std::string text;
    for (std::size_t at = 0; at < digits.size(); ++at) {
        if (at > first && (digits.size() - at) % 3 == 0)
            text += ',';
        text += digits[at];
    }
    return text;
}

std::string with_decimals(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos)
        text.erase(0, 1);
    return text;
}

}  // namespace reprise::world
