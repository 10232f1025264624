#pragma once

#include "replay/trace_reader.h"

namespace reprise::replay {

/// Byte for byte.
bool equal_ticks(const RecordedTick& expected, const RecordedTick& found);

/// As above, with the chain left out: it differs for ever after the first difference, and from the
/// first tick on when the runs did not start from the same.
bool equal_ticks_but_for_chain(const RecordedTick& expected, const RecordedTick& found);

}  // namespace reprise::replay
