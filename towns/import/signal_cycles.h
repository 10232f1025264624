#pragma once

#include <string>

namespace reprise::towns {

/// What became of the signal programs that netconvert made up.
struct ShortenedCycles {
    int programs = 0;    ///< shortened
    double longest = 0;  ///< [s] of what one of them took before
};

/// Where many roads meet, netconvert gives each a green of its own, as long as if there were two of
/// them: some wait five minutes. Of such programs those get green together who meet nobody
/// (united_greens.h); where a cycle still takes more than 2 minutes, greens become shorter, all in
/// the same proportion and none below 6 s. Others keep every byte.
ShortenedCycles shorten_cycles(std::string& network);

}  // namespace reprise::towns
