#pragma once

namespace reprise::scripting {

/// Functions of the C library that Lua calls in the middle of one instruction: charged.cpp defines
/// them for the whole program, and charges the script that runs. Called so that the linker takes
/// it.
void link_charged_functions();

}  // namespace reprise::scripting
