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

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
    constexpr std::size_t longest_word = 100;
    if (word.size() > longest_word)
        return "";
    std::size_t best = 1 + word.size() / 3;
    const std::string* nearest = nullptr;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance <= best && (nearest == nullptr || distance < best)) {
            best = distance;
            nearest = &candidate;
        }
    }
    return nearest == nullptr ? "" : " (did you mean '" + *nearest + "'?)";
}

}  // namespace reprise::world
