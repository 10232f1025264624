#pragma once

namespace reprise::traffic {

/// In programs with SUMO, operator new gives small blocks side by side, on huge pages: a step of
/// SUMO's asks for 2,000 of them, and looks at many that were asked for minutes apart. Whether this
/// is such a block: a test's question. Addresses decide nothing, here as elsewhere.
bool is_small_block(const void* block);

}  // namespace reprise::traffic
