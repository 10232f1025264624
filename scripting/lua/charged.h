#pragma once

#include <cstdint>

namespace reprise::scripting {

/// Functions of the C library that Lua calls in the middle of one instruction: charged.cpp defines
/// them for the whole program. They say to `pay` what they cost in instructions; from then on.
void charge_library_calls(void (*pay)(std::uint64_t instructions));

}  // namespace reprise::scripting
