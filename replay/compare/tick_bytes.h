#pragma once

#include "replay/trace_reader.h"

namespace reprise::replay {

/// Two ticks of the same index, reduced to what both hold: traces may be of different levels.
struct CommonPart {
    CommonPart(const RecordedTick& expected_tick, const RecordedTick& found_tick);

    RecordedTick expected;  ///< borrowed from the arguments and from this
    RecordedTick found;

  private:
    flatbuffers::DetachedBuffer inputs_;
};

/// Byte for byte, of what both hold.
bool equal_ticks(const RecordedTick& expected, const RecordedTick& found);

/// As above, with the chain left out: it differs for ever after the first difference, and from the
/// first tick on when the runs did not start from the same.
bool equal_ticks_but_for_chain(const RecordedTick& expected, const RecordedTick& found);

}  // namespace reprise::replay
