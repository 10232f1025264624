#pragma once

#include "replay/mcap/mcap.h"

namespace reprise::test {

/// Makes a trace out of records of a data section, however wild: every checksum is made right and
/// an index is written behind them. So a fuzzer gets behind the checksums, to what they guard.
replay::mcap::Bytes finished_trace(replay::mcap::View records);

}  // namespace reprise::test
