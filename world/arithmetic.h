#pragma once

#include <string>

namespace reprise::world {

/// What of this thread's arithmetic or this process's locale is not as every recorded run has it,
/// in words ("denormal numbers are flushed to zero"), or "". Numbers must round to nearest, keep
/// denormals and raise no signals (SSE and x87), and have a point in them. About 30 ns without the
/// locale.
std::string unusual_arithmetic();
std::string unusual_locale();

/// The part of it that a library can change in the middle of a run; about 5 ns.
bool is_plain_arithmetic();

}  // namespace reprise::world
