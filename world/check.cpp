#include "world/check.h"

#include <algorithm>

namespace reprise::world {

namespace {

/// Edit distance with swaps of neighbours counted as one (optimal string alignment). O(n m).
std::size_t edit_distance(const std::string& source, const std::string& target) {
    const std::size_t rows = source.size() + 1;
    const std::size_t columns = target.size() + 1;
    std::vector<std::size_t> cost(rows * columns);
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            std::size_t& here = cost[i * columns + j];
            if (i == 0 || j == 0) {
                here = i + j;
                continue;
            }
            const bool same = source[i - 1] == target[j - 1];
            here = std::min({cost[(i - 1) * columns + j] + 1,
                             cost[i * columns + j - 1] + 1,
                             cost[(i - 1) * columns + j - 1] + (same ? 0 : 1)});
            const bool swapped =
                i > 1 && j > 1 && source[i - 1] == target[j - 2] && source[i - 2] == target[j - 1];
            if (swapped)
                here = std::min(here, cost[(i - 2) * columns + j - 2] + 1);
        }
    }
    return cost.back();
}

}  // namespace

void check_failed(const char* condition, const char* file, int line, const std::string& values) {
    const std::string path = file;
    const auto room = path.rfind('/', path.rfind('/') - 1);
    throw CheckFailed(path.substr(room == std::string::npos ? 0 : room + 1) + ":" +
                      std::to_string(line) + ": check failed: " + condition + ": " + values);
}

namespace {

/// Between '_' and at capitals: "HardRainNoon" and "hard_rain_noon" have the same ones.
std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words(1);
    for (const char letter : name) {
        const bool is_capital = letter >= 'A' && letter <= 'Z';
        if ((letter == '_' || is_capital) && !words.back().empty())
            words.emplace_back();
        if (letter != '_')
            words.back() += is_capital ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    return words;
}

/// How many of the words stand in the name as well, or nearly.
std::size_t shared_words(const std::vector<std::string>& words, const std::string& name) {
    constexpr std::size_t shortest_word = 3;
    const std::vector<std::string> others = words_of(name);
    return static_cast<std::size_t>(
        std::count_if(words.begin(), words.end(), [&](const std::string& word) {
            return word.size() >= shortest_word &&
                   std::any_of(others.begin(), others.end(), [&](const std::string& other) {
                       return edit_distance(word, other) <= word.size() / 4;
                   });
        }));
}

bool are_the_same_but_for_capitals(const std::string& word, const std::string& name) {
    const auto small = [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    };
    return std::equal(
        word.begin(), word.end(), name.begin(), name.end(), [&](char letter, char other) {
            return small(letter) == small(other);
        });
}

/// The name that shares most words; of several the one that is most alike.
const std::string* of_same_words(const std::string& word,
                                 const std::vector<std::string>& candidates) {
    const std::vector<std::string> words = words_of(word);
    const std::string* best = nullptr;
    std::size_t most = 0;
    for (const std::string& candidate : candidates) {
        const std::size_t shared = shared_words(words, candidate);
        if (shared > most || (shared > 0 && shared == most &&
                              edit_distance(word, candidate) < edit_distance(word, *best))) {
            most = shared;
            best = &candidate;
        }
    }
    return best;
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
    constexpr std::size_t longest_word = 100;
    if (word.size() > longest_word)
        return "";
    std::size_t best = 1 + word.size() / 3;
    const std::string* nearest = nullptr;
    for (const std::string& candidate : candidates) {
        const std::size_t distance =
            are_the_same_but_for_capitals(word, candidate) ? 0 : edit_distance(word, candidate);
        if (distance <= best && (nearest == nullptr || distance < best)) {
            best = distance;
            nearest = &candidate;
        }
    }
    // A slip of the fingers comes first, then a whole word, then what is just alike.
    if (nearest == nullptr || best > 1)
        if (const std::string* same = of_same_words(word, candidates))
            nearest = same;
    return nearest == nullptr ? "" : " (did you mean '" + *nearest + "'?)";
}

}  // namespace reprise::world
