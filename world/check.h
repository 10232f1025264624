#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace reprise::world {

/// The user's mistake: one line that names file and line, says what was expected and suggests a way
/// out. Programs print it and exit with 2.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Our mistake: a REPRISE_CHECK that did not hold. Programs print it with the command that returns
/// to the tick, and exit with 70 (EX_SOFTWARE).
class CheckFailed : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

/// Throws CheckFailed. `values` should name the tick and the values that broke the rule.
[[noreturn]] void check_failed(const char* condition,
                               const char* file,
                               int line,
                               const std::string& values);

/// The candidate closest to `word` by edit distance, as " (did you mean 'sedan'?)", or "" when none
/// is near. For messages about unknown names.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace reprise::world

/// Always on, in every build. `values` is evaluated only on failure.
#define REPRISE_CHECK(condition, values)                                            \
    do {                                                                            \
        if (!(condition))                                                           \
            ::reprise::world::check_failed(#condition, __FILE__, __LINE__, values); \
    } while (false)
