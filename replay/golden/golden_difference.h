#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "replay/compare/divergence.h"
#include "replay/golden/golden.h"

namespace reprise::replay {

/// What a person would say changed, the worst first.
enum class Severity : std::uint8_t {
    verdicts,  ///< the run or a check ends otherwise
    events,    ///< the same verdicts, another story
    numbers    ///< the same story, other numbers
};

const char* to_word(Severity severity);

/// One difference: the golden's value and the candidate's; "-" where one of them has none.
struct Changed {
    std::uint64_t tick = 0;
    std::string what;  ///< "check 'gap'", "ego#1 x", "finished"
    std::string expected;
    std::string found;
    std::uint32_t line = 0;  ///< in the scenario; 0: none
};

/// One list of a golden (events, checkpoints or states), compared by position with the candidate's.
struct Tally {
    std::size_t different = 0;
    std::size_t all = 0;
    std::optional<Changed> first;
};

/// How a run differs from its golden.
struct GoldenDifference {
    Severity severity = Severity::numbers;
    std::vector<Changed> verdicts;  ///< of the run and of each check that ends otherwise
    std::vector<Changed> details;   ///< of checks that end alike with other numbers
    Tally events;
    Tally checkpoints;              ///< `what`: the stages that differ since the last one
    std::uint64_t equal_until = 0;  ///< last tick up to which all stages are equal
    Tally states;
};

/// Everything that is compared; nothing when all of it is equal.
std::optional<GoldenDifference> compare(const Golden& expected, const Golden& found);

/// What the two runs started from, where that differs: the scenario's text, the town, the seed, a
/// parameter, ... By itself no reason to fail.
std::vector<Changed> start_differences(const Golden& expected, const Golden& found);

}  // namespace reprise::replay
