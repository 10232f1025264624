#include "cli/fingerprint/other_build.h"

#include <algorithm>

#include "cli/process/say.h"

namespace reprise::cli {

void print_other_build(const std::string& headline,
                       const std::string& expected_name,
                       const replay::Fingerprint& expected,
                       const std::string& found_name,
                       const replay::Fingerprint& found) {
    const auto lines = replay::build_differences(expected, found);
    if (lines.empty())
        return;
    say("{}; equal bytes are not promised\n", headline);
    std::size_t widest = 0;
    for (const replay::BuildDifference& line : lines)
        widest = std::max(widest, line.key.size());
    for (const replay::BuildDifference& line : lines)
        say("  {:<{}}  {} {}, {} {}\n",
            line.key,
            std::max<std::size_t>(widest, 11),
            expected_name,
            line.expected,
            found_name,
            line.found);
}

}  // namespace reprise::cli
