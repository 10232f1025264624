#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "process/children.h"
#include "process/limits.h"

namespace reprise::process {

/// Work for a copy of this process: what we have so far, it has, and we see nothing of what it does
/// but its result. It writes where we write.
struct Copy {
    std::string subject;                ///< what it is about, such as a file; begins messages
    std::function<std::string()> work;  ///< what it returns or throws comes to us
    Limits limits{};
};

/// What became of one.
struct CopyResult {
    enum class How : std::uint8_t {
        returned,
        mistake,  ///< the user's, who gave us too much to do perhaps: world::Error, or a limit
        fault     ///< ours: anything else that it threw, or a crash
    };

    How how = How::fault;
    std::string text;  ///< what it returned, or one line that says what went wrong
};

/// What the work returns. A mistake is thrown as world::Error, a fault as std::runtime_error.
std::string run_copy(const Copy& copy);

/// Some at a time; results in the order of `copies`. Only one thread may run: a copy has no other
/// (checked).
std::vector<CopyResult> run_copies(const Children& children, const std::vector<Copy>& copies);

}  // namespace reprise::process
